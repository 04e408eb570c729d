// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Hypoplastic sand in element tests, against an independent integration
// with small steps (scripts/lab element-tests table), and against what the
// theory implies: Bauer's law along the loosest state, and the friction angle
// phi_c and the void ratio e_c in the critical state wherever the test began.
#include <algorithm>

#include "hypoplastic_test.h"

struct Row
{
  double strain, lateral, axial, void_ratio;
};



/** One element test: the rows are those of scripts/lab element-tests. */
struct ElementTest
{
  const char   *name;
  const double *values;
  char          kind; // t: triaxial, e: extension, o: oedometer
  double        void_ratio, pressure;
  Row           rows[6];
};



const ElementTest element_tests[] = {
  {"Karlsruhe sand, triaxial, dense",
   karlsruhe,
   't',
   0.56,
   1e5,
   {
     {0.100, 1.000000e+05, 3.872893e+05, 0.612478},
     {0.200, 1.000000e+05, 3.505539e+05, 0.654194},
     {0.300, 1.000000e+05, 3.344410e+05, 0.682332},
     {0.400, 1.000000e+05, 3.250677e+05, 0.702923},
     {0.500, 1.000000e+05, 3.189192e+05, 0.718578},
     {0.600, 1.000000e+05, 3.146073e+05, 0.730747},
   }},
  {"Karlsruhe sand, triaxial, medium",
   karlsruhe,
   't',
   0.66,
   1e5,
   {
     {0.100, 1.000000e+05, 3.387718e+05, 0.673934},
     {0.200, 1.000000e+05, 3.277433e+05, 0.696671},
     {0.300, 1.000000e+05, 3.207268e+05, 0.713779},
     {0.400, 1.000000e+05, 3.158977e+05, 0.726994},
     {0.500, 1.000000e+05, 3.124084e+05, 0.737372},
     {0.600, 1.000000e+05, 3.098043e+05, 0.745616},
   }},
  {"Karlsruhe sand, triaxial, loose",
   karlsruhe,
   't',
   0.88,
   1e5,
   {
     {0.100, 1.000000e+05, 2.854215e+05, 0.850206},
     {0.200, 1.000000e+05, 2.874915e+05, 0.838966},
     {0.300, 1.000000e+05, 2.893180e+05, 0.829435},
     {0.400, 1.000000e+05, 2.909240e+05, 0.821385},
     {0.500, 1.000000e+05, 2.923236e+05, 0.814610},
     {0.600, 1.000000e+05, 2.935334e+05, 0.808927},
   }},
  {"Karlsruhe sand, triaxial, dense, 1 MPa",
   karlsruhe,
   't',
   0.56,
   1e6,
   {
     {0.100, 1.000000e+06, 3.767811e+06, 0.583446},
     {0.200, 1.000000e+06, 3.461625e+06, 0.620870},
     {0.300, 1.000000e+06, 3.313365e+06, 0.646103},
     {0.400, 1.000000e+06, 3.227026e+06, 0.664440},
     {0.500, 1.000000e+06, 3.170403e+06, 0.678283},
     {0.600, 1.000000e+06, 3.130762e+06, 0.688965},
   }},
  {"Karlsruhe sand, extension, extension",
   karlsruhe,
   'e',
   0.56,
   1e5,
   {
     {0.025, 1.000000e+05, 2.406810e+04, 0.567214},
     {0.050, 1.000000e+05, 2.478719e+04, 0.577888},
     {0.075, 1.000000e+05, 2.556831e+04, 0.587741},
     {0.100, 1.000000e+05, 2.621614e+04, 0.596883},
     {0.125, 1.000000e+05, 2.676543e+04, 0.605412},
     {0.150, 1.000000e+05, 2.723991e+04, 0.613405},
   }},
  {"Hochstetten sand, triaxial, dense",
   hochstetten,
   't',
   0.65,
   1e5,
   {
     {0.100, 1.000000e+05, 4.786350e+05, 0.689697},
     {0.200, 1.000000e+05, 4.038729e+05, 0.738434},
     {0.300, 1.000000e+05, 3.754992e+05, 0.765427},
     {0.400, 1.000000e+05, 3.616600e+05, 0.782105},
     {0.500, 1.000000e+05, 3.537416e+05, 0.792940},
     {0.600, 1.000000e+05, 3.488548e+05, 0.800157},
   }},
  {"Karlsruhe sand, oedometer, dense",
   karlsruhe,
   'o',
   0.56,
   1e4,
   {
     {0.003333333, 2.597614e+04, 4.962989e+04, 0.554809},
     {0.006666667, 6.907438e+04, 1.461911e+05, 0.549635},
     {0.010, 1.529015e+05, 3.324921e+05, 0.544478},
     {0.013333333, 2.943713e+05, 6.453978e+05, 0.539338},
     {0.016666667, 5.123063e+05, 1.125355e+06, 0.534215},
     {0.020, 8.271753e+05, 1.815997e+06, 0.529110},
   }},
  {"Karlsruhe sand, oedometer, loose",
   karlsruhe,
   'o',
   0.88,
   1e4,
   {
     {0.010, 4.054297e+04, 7.748894e+04, 0.861294},
     {0.020, 1.424755e+05, 2.777551e+05, 0.842774},
     {0.030, 3.664374e+05, 7.158254e+05, 0.824438},
     {0.040, 7.792890e+05, 1.522769e+06, 0.806284},
     {0.050, 1.461962e+06, 2.856744e+06, 0.788311},
     {0.060, 2.509954e+06, 4.904231e+06, 0.770517},
   }}};



void
test_against_reference()
{
  std::printf("strain, lateral and axial stress / 100 kPa, void ratio\n");
  for (const ElementTest &test : element_tests)
    {
      Sample<Law> sample(parameters_of(test.values),
                         test.pressure,
                         test.void_ratio);
      std::printf("%s\n", test.name);
      double       error  = 0.;
      double       strain = 0.;
      const double sign   = test.kind == 'e' ? 1. : -1.;
      sample.variable[1] *= -sign;
      for (const Row &row : test.rows)
        {
          const int    n    = 400;
          const double step = (row.strain - strain) / n;
          for (int i = 0; i < n; ++i)
            if (test.kind == 'o')
              sample.strain(0., -step);
            else
              sample.strain_at_lateral_stress(-test.pressure, sign * step);
          strain = row.strain;
          std::printf("%.4f %.4f %.4f %.4f\n",
                      strain,
                      -1e-5 * sample.lateral,
                      -1e-5 * sample.axial,
                      sample.void_ratio);
          raise(error, std::fabs(-sample.lateral / row.lateral - 1.));
          raise(error, std::fabs(-sample.axial / row.axial - 1.));
          raise(error, std::fabs(sample.void_ratio - row.void_ratio));
        }
      report("difference from the reference", error, 1e-3);
    }
}



/** Isotropic compression of the loosest sand: e = e_i0 exp(-(3p/h_s)^n). */
void
test_isotropic_compression()
{
  const double pressure = 1e3;
  const auto   bauer    = [](const double p) {
    return karlsruhe[5] *
           std::exp(-std::pow(3. * p / karlsruhe[1], karlsruhe[2]));
  };
  // the law sees the mean stress increased by p_t
  const double shift = karlsruhe[8];
  Sample<Law>  sample(parameters_of(karlsruhe),
                     pressure,
                     bauer(pressure + shift));
  double       error = 0.;
  for (int i = 0; i < 4000; ++i)
    {
      sample.strain(-1e-5, -1e-5);
      raise(error, std::fabs(sample.void_ratio - bauer(shift - sample.axial)));
    }
  std::printf("Isotropic compression\npressure reached / 1 MPa: %.3f\n",
              -1e-6 * sample.axial);
  report("difference from Bauer's law", error, 1e-5);
}



/** Where all triaxial tests end, whatever their density and pressure. */
void
test_critical_state()
{
  std::printf("Critical state: friction angle, void ratio over e_c\n");
  for (const double *values : {karlsruhe, hochstetten})
    for (const double start : {values[3] + 0.03, values[4] + 0.05})
      {
        const double pressure = 2e5;
        Sample<Law>  sample(parameters_of(values), pressure, start);
        double       peak = 0.;
        for (int i = 0; i < 3000; ++i)
          {
            sample.strain_at_lateral_stress(-pressure, -2e-3);
            peak = std::max(peak, sample.axial / sample.lateral);
          }
        const auto angle = [](const double ratio) {
          return degrees * std::asin((ratio - 1.) / (ratio + 1.));
        };
        const double p = -(sample.axial + 2. * sample.lateral) / 3.;
        const double e_c =
          values[4] * std::exp(-std::pow(3. * p / values[1], values[2]));
        std::printf("e = %.2f at the start: peak %.1f, end %.2f (%.0f), %.4f\n",
                    start,
                    angle(peak),
                    angle(sample.axial / sample.lateral),
                    values[0],
                    sample.void_ratio / e_c);
      }
}



int
main()
{
  test_against_reference();
  test_isotropic_compression();
  test_critical_state();
}
