// SPDX-License-Identifier: LGPL-2.1-or-later
//
// All types that the kernels work on, for the kernels themselves. The floors
// above include only the parts that they use.
#ifndef caisson_mpm_kernels_layout_h
#define caisson_mpm_kernels_layout_h

#include <caisson_mpm/kernels/blocks.h>
#include <caisson_mpm/kernels/cell_moments.h>
#include <caisson_mpm/kernels/cells.h>
#include <caisson_mpm/kernels/kernel_table.h>
#include <caisson_mpm/kernels/material.h>
#include <caisson_mpm/kernels/nodal_sums.h>
#include <caisson_mpm/kernels/settings.h>
#include <caisson_mpm/kernels/step_context.h>
#include <caisson_mpm/kernels/update_result.h>
#include <caisson_mpm/kernels/views.h>

#endif
