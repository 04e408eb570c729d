// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/row_file.h>

#include <deal.II/base/exceptions.h>

#include <boost/algorithm/string/join.hpp>

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    std::string
    line_of(const std::vector<std::string> &words)
    {
      return boost::algorithm::join(words, ",") + "\n";
    }

    std::vector<double>
    numbers_in(const std::string &line)
    {
      std::vector<double> values;
      std::istringstream  words(line);
      for (std::string word; std::getline(words, word, ',');)
        values.push_back(std::strtod(word.c_str(), nullptr));
      return values;
    }
  } // namespace

  RowFile::RowFile(const std::string              &path,
                   const std::vector<std::string> &columns,
                   const int                       digits)
    : path(path)
    , header(line_of(columns))
    , n_columns(columns.size())
    , digits(digits)
  {}

  void
  RowFile::create()
  {
    start_with(header);
  }

  RowFile::Rows
  RowFile::resume(const double time)
  {
    std::string kept = header;
    const Rows  rows = rows_until(time, &kept);
    start_with(kept);
    return rows;
  }

  RowFile::Rows
  RowFile::rows_until(const double time, std::string *const kept) const
  {
    const std::string text = read_text(path);
    if (text.empty())
      return {};
    if (text.compare(0, header.size(), header) != 0)
      throw BadInput(path + " has other columns than this run writes, so that "
                            "the run cannot continue it. Restore the file as "
                            "the run had written it, or start without "
                            "--restart.");
    const double       tolerance = 1e-9 * std::abs(time); // times are rounded
    Rows               rows;
    std::istringstream lines(text.substr(header.size()));
    for (std::string line; std::getline(lines, line) && !lines.eof();)
      {
        const std::vector<double> values = numbers_in(line);
        if (values.size() != n_columns || values[0] > time + tolerance)
          continue;
        if (kept != nullptr)
          *kept += line + "\n";
        rows.push_back(values);
      }
    return rows;
  }

  void
  RowFile::append(const std::vector<double> &values)
  {
    Assert(file != nullptr, dealii::ExcMessage("call create() or resume()"));
    AssertDimension(values.size(), n_columns);
    std::vector<std::string> words;
    for (const double value : values)
      words.push_back(to_text(value, digits));
    const std::string line = line_of(words);
    if (std::fwrite(line.data(), 1, line.size(), file.get()) != line.size())
      {
        const int error = errno;
        // a part of the row may be in the file
        const bool shortened = ftruncate(fileno(file.get()), size) == 0;
        report_unwritable(path,
                          error,
                          shortened ? "the rows so far are kept" :
                                      "its last row is incomplete");
      }
    size += line.size();
    written.add(line);
  }

  void
  RowFile::start_with(const std::string &text)
  {
    file.reset();
    write_atomically(path, text);
    file.reset(std::fopen(path.c_str(), "ab"));
    if (file == nullptr)
      report_unwritable(path, errno);
    // a row that was taken back must not be written again when closing
    std::setvbuf(file.get(), nullptr, _IONBF, 0);
    size    = text.size();
    written = Fingerprint();
    written.add(text);
  }
} // namespace CaissonMPM
