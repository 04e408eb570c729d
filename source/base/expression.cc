// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/expression.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  Expression::Expression(const std::string &text, const std::string &where)
    : function(std::make_unique<FunctionParser<2>>(1))
    , zero(text == "0")
  {
    std::ostringstream reason;
    try
      {
        function->initialize("r,z,t", text, {{"pi", pi}}, true);
        // the parser looks at the expression when it is used first
        function->value(Point<2>(1., -1.));
        return;
      }
    catch (const ExceptionBase &e)
      {
        e.print_info(reason);
      }
    std::string        words;
    std::istringstream in(reason.str());
    for (std::string word; in >> word;)
      words += " " + word;
    throw BadInput(where + " must be an expression in r, z, t and pi:" + words);
  }

  VectorExpression
  parse_vector(const std::string &text,
               const std::string &where,
               const std::string &empty_word)
  {
    const auto parts = Utilities::split_string_list(text, ';');
    if (parts.size() != 2)
      throw BadInput(where + " = " + text +
                     " must be two expressions, for r and for z, with a "
                     "semicolon between them, for instance 0 ; -0.1*t.");
    VectorExpression result;
    for (unsigned int d = 0; d < 2; ++d)
      if (empty_word.empty() || parts[d] != empty_word)
        result[d] =
          Expression(parts[d], where + " = " + text + ": \"" + parts[d] + "\"");
    return result;
  }
} // namespace CaissonMPM
