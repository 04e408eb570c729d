// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/version.h>
#include <caisson_mpm/base/version_number.h>

namespace CaissonMPM
{
  const char *
  program_version()
  {
    return CAISSON_MPM_VERSION;
  }
} // namespace CaissonMPM
