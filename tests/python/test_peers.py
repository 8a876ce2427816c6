#!/usr/bin/env python3
"""Measured maps beside SurfaceTopography and surfalize: levels, filters, root mean squares, files of instruments.

usage: test_peers.py --program WAVYCON --package FOLDER --needs PACKAGES --environment FOLDER, as test_package.py

Differences are over the rms height of the map that is compared; largest ones are printed, for tests/evidence.md.
"""
import math
import os
import pathlib
import re
import subprocess
import warnings

from program import ProgramTest, main
from virtual_environment import go_on_with_package

SIDES = 3.0, 2.0
M, N = 96, 72       # points along x and y
CUT_OFF = 0.23      # between the waves of the cell
ROUNDING, SINGLE = 1e-12, 1e-6
# surfalize's Gaussian filter ends four standard deviations from its middle: beyond these lies erfc(4/sqrt(2)) of it.
END_OF_KERNEL = 2e-4
# Formats that surfalize writes and SurfaceTopography reads, and the unit [um] that surfalize takes for um: those
# of TrueMap (.tmd) are in mm, as SurfaceTopography reads them.
FORMATS = {"al3d": 1, "sdf": 1, "sur": 1, "tmd": 1000}


class Peers(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(cls.folder)
        warnings.simplefilter("ignore", wc.Note)
        rng = numpy.random.default_rng(4)
        x, y = numpy.arange(M)/M, numpy.arange(N)[:, None]/N
        cls.h = rng.normal(size=(N, M)) + 5*x - 3*y + 4*x*x - 2*x*y + numpy.cos(2*numpy.pi*(3*x + y))
        cls.holes = cls.h.copy()
        cls.holes[5:12, 30:41] = cls.holes[60, 80] = numpy.nan
        cls.largest = {}

    @classmethod
    def tearDownClass(cls):
        for name, difference in cls.largest.items():
            print(f"{name}: {difference:.1e}")

    def prepared(self, h, **keys):
        """The heights that are solved, over their mean: the gap at first touch, turned over."""
        surface = wc.heights(h, length_x=SIDES[0], length_y=SIDES[1], **keys)
        gap = wc.solve(surface, pbar_over_pstar=0)[0].gap
        return gap.mean() - gap

    def same(self, name, ours, theirs, limit=ROUNDING):
        """Compares heights up to a constant, where both have them."""
        there = ~numpy.isnan(theirs)
        difference = (ours - theirs)[there]
        found = numpy.abs(difference - difference.mean()).max()/numpy.std(theirs[there])
        self.largest[name] = max(found, self.largest.get(name, 0.0))
        with self.subTest(name=name):
            self.assertLess(found, limit)

    def test_levels(self):
        for h, keys in (self.h, {}), (self.holes, {"fill_missing": "harmonic"}):
            topography, surface = self.topography(h), surfalize.Surface(h, SIDES[0]/M, SIDES[1]/N)
            for ours, theirs, degree in ("mean", "center", 0), ("plane", "height", 1), ("quadratic", "curvature", 2):
                found = self.prepared(h, detrend=ours, **keys)
                self.same(f"level {ours}, SurfaceTopography", found, heights_of(topography.detrend(theirs)))
                if degree:
                    self.same(f"level {ours}, surfalize", found, surface.detrend_polynomial(degree).data)
        # Lines keep their tilt; those of SurfaceTopography get the same median.
        aligned = self.topography(self.h).scan_line_align(mode="median", degree=0)
        self.same("level lines, SurfaceTopography", self.prepared(self.h, detrend="lines"), heights_of(aligned))

    def test_filters(self):
        """Short waves, and long ones, are left out: periodic maps, and maps that mirror images continue."""
        topography = self.topography(self.h, periodic=True)
        surface = surfalize.Surface(self.h, SIDES[0]/M, SIDES[1]/N)

        def passed(q):
            """Of ISO 16610-61, q = 2 pi over the wavelength: half of a wave of the cut-off."""
            return numpy.exp(-numpy.log(2)*(CUT_OFF*q/(2*numpy.pi))**2)

        exact = {"short_wavelength": topography.filter(passed, isotropic=True),
                 "long_wavelength": topography.filter(lambda q: 1 - passed(q), isotropic=True)}
        sharp = {"short_wavelength": topography.shortcut(cutoff_wavelength=CUT_OFF, kind="circular step"),
                 "long_wavelength": topography.longcut(cutoff_wavelength=CUT_OFF, kind="circular step")}
        for key, kind in ("short_wavelength", "lowpass"), ("long_wavelength", "highpass"):
            cut = {key: CUT_OFF}
            self.same(f"sharp {key}, SurfaceTopography", self.prepared(self.h, **cut), heights_of(sharp[key]))
            periodic = self.prepared(self.h, filter="gaussian", **cut)
            self.same(f"gaussian {key}, SurfaceTopography", periodic, heights_of(exact[key]))
            for edges, continued in ("periodic", "wrap"), ("mirror", "reflect"):
                ours = self.prepared(self.h, filter="gaussian", edges=edges, **cut)
                theirs = surfalize.filter.GaussianFilter(CUT_OFF, kind, continued)(surface).data
                self.same(f"gaussian {key}, {edges}, surfalize", ours, theirs, END_OF_KERNEL)
            # Both continuations differ at the border alone: here ours is the mirrored map.
            steps = [math.ceil(CUT_OFF*points/side) for points, side in ((N, SIDES[1]), (M, SIDES[0]))]
            far = tuple(slice(step, -step) for step in steps)
            self.same(f"gaussian {key}, mirrored and not, a cut-off from the border", ours[far], periodic[far],
                      END_OF_KERNEL)
            self.same(f"gaussian {key}, mirrored and not, at the border", ours, periodic, math.inf)

    def test_root_mean_squares(self):
        """Of the Fourier series, by derivatives of it; by differences, in the head of tables."""
        smooth = self.prepared(self.h, short_wavelength=CUT_OFF)
        topography = self.topography(smooth, periodic=True)
        half_laplacian = topography.filter(lambda q: q*q/2, isotropic=True)
        surface = wc.solve(wc.heights(smooth, length_x=SIDES[0], length_y=SIDES[1]), pbar_over_pstar=0).surface
        around, within = self.head(smooth), self.head(smooth, edges="mirror")
        peer = surfalize.Surface(smooth, SIDES[0]/M, SIDES[1]/N)
        for name, ours, theirs in (
                ("rms height, SurfaceTopography", surface.rms_height, topography.rms_height_from_area()),
                ("rms height, surfalize", surface.rms_height, peer.Sq()),
                ("rms slope of the series", surface.rms_slope, rms(*topography.fourier_derivative())),
                ("rms curvature of the series", surface.rms_curvature, rms(heights_of(half_laplacian))),
                ("slope by differences", around["slope"], topography.rms_gradient()),
                ("curvature by differences", around["curvature"], topography.rms_curvature_from_area()),
                ("slope within the map, surfalize", within["slope"], peer.Sdq())):
            self.largest[name] = abs(ours/theirs - 1)
            with self.subTest(name=name):
                self.assertLess(self.largest[name], ROUNDING)
        # Within a map that does not repeat SurfaceTopography has differences along both sides at the same points alone.
        both = rms(numpy.diff(smooth, axis=1)[:-1]*M/SIDES[0], numpy.diff(smooth, axis=0)[:, :-1]*N/SIDES[1])
        self.assertAlmostEqual(1, both/self.topography(smooth).rms_gradient(), delta=ROUNDING)
        self.largest["slope within the map, SurfaceTopography"] = abs(within["slope"]/both - 1)

    def head(self, h, **keys):
        """Slope and curvature by differences in the head of a table."""
        numpy.save("map.npy", h)
        more = "".join(f", {key} = '{value}'" for key, value in keys.items())
        pathlib.Path("map.nml").write_text(
            f"&surface kind = 'file', file = 'map.npy', length_x = {SIDES[0]}, length_y = {SIDES[1]}{more} /\n"
            "&load pbar_over_pstar = 0 /\n", encoding="utf-8")
        subprocess.run([self.program, "map.nml", "--quiet", "--output", "made"], check=True)
        text = pathlib.Path("made/map.summary.dat").read_text(encoding="utf-8")
        return {name: float(number) for name, number in
                re.findall(r"rms_(slope|curvature)_by_differences\[.*?\] = ([^,\n]+)", text)}

    def topography(self, h, periodic=False):
        """SurfaceTopography takes the first index for x; missing heights are masked."""
        return Topography(numpy.ma.masked_invalid(h.T) if numpy.isnan(h).any() else h.T, SIDES, unit="um",
                          periodic=periodic)

    def test_files(self):
        """What surfalize writes, and reads again, is what wavycon reads through SurfaceTopography."""
        h = self.h[:40, :64]   # um
        peer = surfalize.Surface(h, 0.5, 0.25)
        for form, unit in FORMATS.items():
            # SurfaceTopography takes the letters of sur for those of Latin-1.
            peer.save(f"map.{form}", encoding="latin-1" if form == "sur" else "utf-8")
            again = surfalize.Surface.load(f"map.{form}")
            ours = wc.read(f"map.{form}", length_unit="um")
            with self.subTest(form=form):
                self.assertEqual(h.shape, ours.heights.shape)
                self.same(f"file {form}", ours.heights, unit*again.data, SINGLE if form == "tmd" else ROUNDING)
                for key, side in ("length_x", again.step_x*h.shape[1]), ("length_y", again.step_y*h.shape[0]):
                    self.assertAlmostEqual(1, ours.keys[key]/(unit*side), delta=SINGLE)
        # Axes in um, heights in nm: the name of the unit is that of the axes.
        head = pathlib.Path("map.sur").read_bytes()
        self.assertEqual(6, head[:512].count(b"\xb5m"))   # of x, y and z twice
        parts = head.split(b"\xb5m", 6)
        pathlib.Path("nm.sur").write_bytes(b"".join(part + unit for part, unit in zip(parts, [b"\xb5m", b"\xb5m", b"nm"]*2))
                                           + parts[6])
        ours = wc.read("nm.sur")
        self.assertEqual(("um", 32), (ours.length_unit, round(ours.keys["length_x"], 6)))
        self.same("file sur in nm", 1000*ours.heights, surfalize.Surface.load("map.sur").data, ROUNDING)


def rms(*parts):
    """Of the size of a vector with these components, shape (y, x)."""
    return sum(numpy.mean(part**2) for part in parts)**0.5


def heights_of(topography):
    return numpy.ma.filled(numpy.ma.asarray(topography.heights(), dtype=float), numpy.nan).T


if __name__ == "__main__":
    given = go_on_with_package()
    import numpy
    import surfalize
    import surfalize.filter
    import wavycon as wc
    from SurfaceTopography import Topography
    main()
