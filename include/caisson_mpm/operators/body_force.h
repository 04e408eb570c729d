// SPDX-License-Identifier: LGPL-2.1-or-later
//
// An acceleration b besides gravity, given as an expression:
//   f_I += sum m_p N_I(x_p) b(X_p, t),
// with the initial place X_p of the point and its mass without mass scaling.
#ifndef caisson_mpm_operators_body_force_h
#define caisson_mpm_operators_body_force_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/kernels/forward.h>
#include <caisson_mpm/operators/nodal_force.h>


namespace CaissonMPM
{
  /** The nodal force of the entry "Loads/Body force". */
  class BodyForce : public NodalForce, public Section
  {
  public:
    BodyForce();

    std::string
    name() const override;

    void
    check_parameters() const override;

    void
    initialize(const double mass_scaling) override;

    bool
    is_active() const override;

  private:
    void
    add(const ForceContext &context, Kernels::NodalVector *force) override;

    VectorExpression
    parse() const;

    std::string      text = "0 ; 0";
    VectorExpression acceleration;
    double           mass_scaling = 1.;
  };
} // namespace CaissonMPM

#endif
