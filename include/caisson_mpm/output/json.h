// SPDX-License-Identifier: LGPL-2.1-or-later
//
// JSON (RFC 8259) for the few small files that are written; members keep their
// order.
#ifndef caisson_mpm_output_json_h
#define caisson_mpm_output_json_h

#include <caisson_mpm/base/named_numbers.h>

#include <nlohmann/json.hpp>

#include <string>

namespace CaissonMPM
{
  using Json = nlohmann::ordered_json;

  /** Return an object with these members. */
  inline Json
  object_of(const NamedNumbers &values)
  {
    Json result = Json::object();
    for (const auto &[name, value] : values)
      result[name] = value;
    return result;
  }

  /** Return the text of a file; what is not finite is null, and bytes that are
   * no UTF-8 are replaced. */
  inline std::string
  text_of(const Json &json)
  {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }
} // namespace CaissonMPM

#endif
