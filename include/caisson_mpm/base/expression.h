// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Functions of place and time that the user writes as text.
#ifndef caisson_mpm_base_expression_h
#define caisson_mpm_base_expression_h

#include <deal.II/base/function_parser.h>

#include <array>
#include <memory>
#include <string>

namespace CaissonMPM
{
  /**
   * Parse a function of @p variables, as "r,z,t", of which the last is the time
   * of the function if there is one more than @p dim. Throws BadInput if it
   * cannot be parsed or evaluated at @p place; @p where is the beginning of the
   * message, for instance "Loads/Body force".
   */
  template <int dim>
  std::unique_ptr<dealii::FunctionParser<dim>>
  parse_function(const std::string        &text,
                 const std::string        &variables,
                 const dealii::Point<dim> &place,
                 const std::string        &where);

  /**
   * A muParser expression in r and z (m), the time t (s) and pi, for instance
   * "-0.01*z*min(t, 1)". It is parsed once; an empty one has no value.
   */
  class Expression
  {
  public:
    Expression() = default;

    /**
     * Throws BadInput if the text cannot be parsed; @p where is the beginning
     * of the message, for instance "Loads/Body force".
     */
    Expression(const std::string &text, const std::string &where);

    bool
    empty() const
    {
      return !function;
    }

    /** Whether it was written as the number 0, or not at all. */
    bool
    is_zero() const
    {
      return zero;
    }

    /** At (r, z) and the time t. Not for an empty expression. */
    double
    operator()(const dealii::Point<2> &p, const double t) const
    {
      function->set_time(t);
      return function->value(p);
    }

    /** Of the time alone. Throws BadInput, which begins with "where", if the
     * value is not finite. Units of the time: s. */
    double
    at_time(const double t) const;

  private:
    std::string                                where;
    std::unique_ptr<dealii::FunctionParser<2>> function;
    bool                                       zero = true;
  };

  /** The r and z components of a vector. */
  using VectorExpression = std::array<Expression, 2>;

  /**
   * Two expressions with a semicolon between them. A component that reads
   * @p empty_word stays empty. Throws BadInput as Expression does.
   */
  VectorExpression
  parse_vector(const std::string &text,
               const std::string &where,
               const std::string &empty_word = "");
} // namespace CaissonMPM

#endif
