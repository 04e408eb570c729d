# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The program for Spack 1.0 or later, from the sources of this folder:
#   spack repo add packaging/spack_repo/caisson_mpm
#   spack dev-build caisson-mpm@main
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class CaissonMpm(CMakePackage):
    """Installation of suction caissons in sand and clay: an axisymmetric, explicit
    material point method on deal.II."""

    # dev-build takes the sources of the current folder
    url = "file:///nonexistent/caisson_mpm-0.1.0.tar.gz"

    license("LGPL-2.1-or-later")
    version("main")

    variant("python", default=True, description="Pictures, reports and studies")

    depends_on("cxx", type="build")
    depends_on("cmake@3.18:", type="build")
    depends_on("ninja", type="build")
    depends_on("boost+program_options")
    depends_on("dealii@9.4.1:+mpi+p4est+hdf5+muparser+trilinos")
    depends_on("mpi")
    depends_on("nlohmann-json")

    with when("+python"):
        depends_on("python@3.11:", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-scipy", type="run")
        depends_on("py-scikit-learn", type="run")
        depends_on("py-matplotlib", type="run")
        depends_on("py-jinja2", type="run")
        depends_on("py-openpyxl", type="run")
        depends_on("vtk+python", type="run")

    generator("ninja")
    build_targets = ["all"]

    def cmake_args(self):
        """Return what CMake is told: the deal.II of this spec."""
        return [self.define("DEAL_II_DIR", self.spec["dealii"].prefix)]
