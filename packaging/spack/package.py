# Not run: Spack and its mirrors were out of reach where this was written. packaging/README.md says what was tried.
from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Wavycon(CMakePackage):
    """Elastic contact of wavy and rough surfaces (Johnson, Greenwood & Higginson 1985), with error estimates."""

    license("GPL-3.0-or-later")

    # For a release: url, and here sha256 of the archive that scripts/release makes.
    version("0.1.0")

    variant("mpi", default=False, description="Build the parallel program wavycon-mpi")
    variant("plot", default=False, description="Draw tables by wavycon-plot, with gnuplot")
    generator("ninja")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("lapack")
    depends_on("gsl")
    depends_on("fftw precision=float,double")
    depends_on("mpi", when="+mpi")
    # wavycon-plot and wavycon-verify need no packages of it.
    depends_on("python@3.9:", type=("build", "run"))
    depends_on("gnuplot", when="+plot", type="run")

    sanity_check_is_file = ["bin/wavycon", "bin/wavycon-verify", "include/wavycon.h"]

    def cmake_args(self):
        return [
            self.define("WAVYCON_TESTS", False),
            self.define("WAVYCON_STATIC", False),
            self.define("WAVYCON_MPI", "ON" if self.spec.satisfies("+mpi") else "OFF"),
        ]
