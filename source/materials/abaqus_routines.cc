// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The routines of Abaqus that a UMAT finds in the program, called as a compiler
// of Fortran does.
//
// Reference: Abaqus User Subroutines Reference Guide, Utility Routines.
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <sstream>
#include <string>

namespace CaissonMPM
{
  namespace
  {
    using Tensor3 = dealii::SymmetricTensor<2, 3>;

    const char end_of_abaqus[] =
      "has called XIT, or STDB_ABQERR with an error, as for a CMNAME (Material "
      "name) or for Properties that it does not know";

    // of the components 12, 13, 23
    constexpr unsigned int shear_rows[]    = {0, 0, 1},
                           shear_columns[] = {1, 2, 2};

    /** The factor of shear components: those of strains are engineering ones.
     */
    double
    shear_factor(const int kind)
    {
      return kind == 2 ? .5 : 1.;
    }

    /** The tensor of components @p s: a stress for @p kind = 1, a strain for 2.
     * Throws what says that @p routine has been called with something else. */
    Tensor3
    tensor_of(const char   *routine,
              const double *s,
              const int     kind,
              const int     n_direct,
              const int     n_shear)
    {
      const std::string call = std::string("has called ") + routine + " with ";
      if (kind != 1 && kind != 2)
        throw EndOfAnalysis{call + "LSTR = " + to_text(kind) +
                            ": 1 is a stress, 2 a strain"};
      if (n_direct < 0 || n_direct > 3 || n_shear < 0 || n_shear > 3)
        throw EndOfAnalysis{call + "NDI = " + to_text(n_direct) +
                            " and NSHR = " + to_text(n_shear) +
                            ": each is at most 3"};
      const double *const end = s + n_direct + n_shear;
      if (!std::all_of(s, end, [](const double x) { return std::isfinite(x); }))
        {
          std::string numbers;
          for (const double *x = s; x < end; ++x)
            numbers += (x > s ? ", " : "") + to_text(*x, 6);
          throw EndOfAnalysis{call + (kind == 2 ? "a strain" : "a stress") +
                              " that is not finite: " + numbers};
        }
      Tensor3 result;
      for (int i = 0; i < n_direct; ++i)
        result[i][i] = s[i];
      for (int i = 0; i < n_shear; ++i)
        result[shear_rows[i]][shear_columns[i]] =
          shear_factor(kind) * s[n_direct + i];
      return result;
    }

    /** Principal values, the largest first, and their directions. */
    auto
    principal(const Tensor3 &t)
    {
      return dealii::eigenvectors(
        t, dealii::SymmetricTensorEigenvectorMethod::jacobi);
    }

    /** The text with the next number or word for each %I, %R and %S. */
    std::string
    text_of_message(const std::string &text,
                    const int         *whole_numbers,
                    const double      *numbers,
                    const char        *words)
    {
      constexpr std::size_t length_of_word = 8;
      std::ostringstream    message;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const std::string mark = text.substr(i, 2);
          i += mark == "%I" || mark == "%R" || mark == "%S" ? 1 : 0;
          if (mark == "%I")
            message << *whole_numbers++;
          else if (mark == "%R")
            message << *numbers++;
          else if (mark == "%S")
            {
              message << std::string(words, length_of_word);
              words += length_of_word;
            }
          else
            message << text[i];
        }
      return message.str();
    }
  } // namespace
} // namespace CaissonMPM

using namespace CaissonMPM;

extern "C"
{
  /** End the analysis. */
  void
  xit_()
  {
    throw EndOfAnalysis{end_of_abaqus};
  }

  /** Print a message; @p lop = -3 ends the analysis. */
  void
  stdb_abqerr_(const int        *lop,
               const char       *text,
               const int        *whole_numbers,
               const double     *numbers,
               const char       *words,
               const std::size_t length)
  {
    constexpr int most      = 20; // a step has many points
    static int    n_printed = 0;
    if (n_printed++ < most)
      std::cerr << "user material: "
                << text_of_message(std::string(text, length),
                                   whole_numbers,
                                   numbers,
                                   words)
                << std::endl;
    if (*lop <= -3)
      throw EndOfAnalysis{end_of_abaqus};
  }

  /** The directory of results: libraries get that of the process. */
  void
  getoutdir_(char *directory, int *length, const std::size_t room)
  {
    std::memset(directory, ' ', room);
    if (room > 0)
      directory[0] = '.';
    *length = 1;
  }

  void
  getjobname_(char *name, int *length, const std::size_t room)
  {
    const std::string job = "caisson_mpm";
    std::memset(name, ' ', room);
    *length = std::min(job.size(), room);
    std::copy_n(job.begin(), *length, name);
  }

  /** The mean stress, and that of von Mises. */
  void
  sinv_(const double *stress,
        double       *mean,
        double       *mises,
        const int    *n_direct,
        const int    *n_shear)
  {
    const Tensor3 t = tensor_of("SINV", stress, 1, *n_direct, *n_shear);
    *mean           = trace(t) / 3.;
    *mises          = std::sqrt(1.5) * deviator(t).norm();
  }

  /** Principal values. */
  void
  sprinc_(const double *s,
          double       *values,
          const int    *kind,
          const int    *n_direct,
          const int    *n_shear)
  {
    const auto found =
      principal(tensor_of("SPRINC", s, *kind, *n_direct, *n_shear));
    for (unsigned int i = 0; i < 3; ++i)
      values[i] = found[i].first;
  }

  /** The same with their directions, AN(K, :) that of PS(K). */
  void
  sprind_(const double *s,
          double       *values,
          double       *directions,
          const int    *kind,
          const int    *n_direct,
          const int    *n_shear)
  {
    const auto found =
      principal(tensor_of("SPRIND", s, *kind, *n_direct, *n_shear));
    for (unsigned int i = 0; i < 3; ++i)
      {
        values[i] = found[i].first;
        for (unsigned int j = 0; j < 3; ++j)
          directions[i + 3 * j] = found[i].second[j];
      }
  }

  /** R S R^T. */
  void
  rotsig_(const double *s,
          const double *rotation,
          double       *rotated,
          const int    *kind,
          const int    *n_direct,
          const int    *n_shear)
  {
    dealii::Tensor<2, 3> r;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        r[i][j] = rotation[i + 3 * j];
    const dealii::Tensor<2, 3> turned =
      r *
      dealii::Tensor<2, 3>(tensor_of("ROTSIG", s, *kind, *n_direct, *n_shear)) *
      transpose(r);
    for (int i = 0; i < *n_direct; ++i)
      rotated[i] = turned[i][i];
    for (int i = 0; i < *n_shear; ++i)
      rotated[*n_direct + i] =
        turned[shear_rows[i]][shear_columns[i]] / shear_factor(*kind);
  }
}
