// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <iostream>
#include <regex>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** Keeps std::cerr to itself: deal.II prints there what muParser says. */
    class CapturedErrors
    {
    public:
      CapturedErrors()
        : previous(std::cerr.rdbuf(text.rdbuf()))
      {}

      ~CapturedErrors()
      {
        std::cerr.rdbuf(previous);
      }

      CapturedErrors(const CapturedErrors &) = delete;
      CapturedErrors &
      operator=(const CapturedErrors &) = delete;

      /** The field of a line such as "Position: <2>". */
      std::string
      field(const std::string &name) const
      {
        const std::string all   = text.str();
        const std::size_t begin = all.find('<', all.find(name + ":"));
        const std::size_t end   = all.find(">\n", begin);
        if (all.find(name + ":") == std::string::npos ||
            begin == std::string::npos || end == std::string::npos)
          return "";
        return all.substr(begin + 1, end - begin - 1);
      }

    private:
      std::ostringstream    text;
      std::streambuf *const previous;
    };

    /** One line of what is wrong with an expression, and where. */
    std::string
    explain(const std::string &expression, const CapturedErrors &errors)
    {
      std::string message = errors.field("Message");
      for (const std::string end : {" at position", " at expression position"})
        message = message.substr(0, message.find(end));
      message = message.substr(0, message.rfind('.'));
      if (message.empty())
        message = expression.empty() ? "it is empty" : "it cannot be parsed";
      // muParser counts from 0, and in a text that deal.II may have changed
      const std::string token    = errors.field("Token");
      const std::string position = errors.field("Position");
      const std::size_t at =
        position.empty() ? std::string::npos : std::stoul(position);
      if (!token.empty() && at < expression.size() &&
          expression.compare(at, token.size(), token) == 0)
        message += " at column " + to_text(at + 1);
      return message;
    }

    /** Throw BadInput where an expression asks for random numbers. */
    void
    refuse_random_numbers(const std::string &text, const std::string &where)
    {
      static const std::regex random("\\brand(_seed)?\\b");
      std::smatch             found;
      if (std::regex_search(text, found, random))
        throw BadInput(
          where + " calls " + found.str() +
          "(): an expression must have the same value at each "
          "call and on each rank, and a random number does not. "
          "Write a function of the place, for instance sin(100*z).");
    }
  } // namespace

  template <int dim>
  std::unique_ptr<FunctionParser<dim>>
  parse_function(const std::string &text,
                 const std::string &variables,
                 const Point<dim>  &place,
                 const std::string &where)
  {
    refuse_random_numbers(text, where);
    auto                 names    = Utilities::split_string_list(variables);
    auto                 function = std::make_unique<FunctionParser<dim>>(1);
    const CapturedErrors errors;
    try
      {
        function->initialize(variables, text, {{"pi", pi}}, names.size() > dim);
        // the parser looks at the expression when it is used first
        function->value(place);
      }
    catch (const std::exception &)
      {
        names.push_back("pi");
        std::string list = names[0];
        for (std::size_t i = 1; i < names.size(); ++i)
          list += (i + 1 < names.size() ? ", " : " and ") + names[i];
        throw BadInput(where + " must be an expression in " + list + ": " +
                       explain(text, errors) + ".");
      }
    return function;
  }

  template std::unique_ptr<FunctionParser<2>>
  parse_function<2>(const std::string &,
                    const std::string &,
                    const Point<2> &,
                    const std::string &);
  template std::unique_ptr<FunctionParser<3>>
  parse_function<3>(const std::string &,
                    const std::string &,
                    const Point<3> &,
                    const std::string &);

  Expression::Expression(const std::string &text, const std::string &where)
    : where(where)
    , function(parse_function<2>(text, "r,z,t", Point<2>(1., -1.), where))
    , zero(text == "0")
  {}

  double
  Expression::at_time(const double t) const
  {
    const double value = (*this)(Point<2>(), t);
    if (value != (*this)(Point<2>(1.3, -2.7), t) && std::isfinite(value))
      throw BadInput(where + " depends on r or z, and may depend on the time t "
                             "alone.");
    if (!std::isfinite(value))
      throw BadInput(where + " is " + to_text(value) + " at t = " + to_text(t) +
                     " s. Write an expression that is finite at all times of "
                     "the run.");
    return value;
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
