/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Linear elastic soil in C. PROPS: Young's modulus (Pa) and Poisson's ratio. */
#include <stddef.h>

void
umat(double *stress, double *statev, double *ddsdde, double *sse, double *spd,
     double *scd, double *rpl, double *ddsddt, double *drplde, double *drpldt,
     const double *stran, const double *dstran, const double *time,
     const double *dtime, const double *temp, const double *dtemp,
     const double *predef, const double *dpred, const char *cmname,
     const int *ndi, const int *nshr, const int *ntens, const int *nstatv,
     const double *props, const int *nprops, const double *coords,
     const double *drot, double *pnewdt, const double *celent,
     const double *dfgrd0, const double *dfgrd1, const int *noel,
     const int *npt, const int *layer, const int *kspt, const int *jstep,
     const int *kinc, size_t length_of_cmname)
{
  const double mu = props[0] / (2. * (1. + props[1])),
               lambda = 2. * mu * props[1] / (1. - 2. * props[1]),
               volume = dstran[0] + dstran[1] + dstran[2];
  for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
        ddsdde[4 * j + i] = lambda + (i == j ? 2. * mu : 0.);
      stress[i] += lambda * volume + 2. * mu * dstran[i];
    }
  ddsdde[15] = mu;
  stress[3] += mu * dstran[3];
}
