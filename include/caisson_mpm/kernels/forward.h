// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The names of the types that the kernels take and return, for headers that
// only pass them on: a change of such a type then recompiles only the files
// that use it.
#ifndef caisson_mpm_kernels_forward_h
#define caisson_mpm_kernels_forward_h

namespace CaissonMPM
{
  namespace Kernels
  {
    struct PointBlock;
    struct PointHistory;
    struct BlockHeader;
    struct CellGeometry;
    struct CellNodes;
    struct Material;
    struct NodalSums;
    struct NodalVector;
    struct CellMoments;
    struct PointsView;
    struct GridView;
    struct CornerView;
    struct StepContext;
    struct PointUpdate;
    struct LeavingPoint;
    struct UpdateResult;
    struct KernelTable;
  } // namespace Kernels
} // namespace CaissonMPM

#endif
