#!/usr/bin/env python3
"""What searches, tables and many loads cost over one load of a rough surface.

usage: option_costs.py --program WAVYCON [--points N]

The surface is self-affine, Hurst exponent 0.8, its longest wave 1/8 of the cell, its shortest 16 points; the load is P
= 0.0125, about 5 % in contact, to a residual of 1e-8. Each row is the processor time of the whole program, user and
system, over that of the load alone; for yield over that of the load that the search finds. The time is the least of
three runs, for each of three seeds.
"""
import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile

from own import Table

SEEDS, RUNS, LOAD = (1985, 1, 2), 3, 0.0125
ELEVEN = "0.00025, 0.0005, 0.001, 0.0015, 0.0025, 0.005, 0.0075, 0.0125, 0.018, 0.025, 0.04"
DECK = """&scene case = 'case' /
&material e_star = 1 /
&surface kind = 'self_affine', long_wavelength = 0.125, short_wavelength = {wave}, rms_slope = 0.1, points = {points},
   seed = {seed} /
&method solver = 'grid', residual = 1e-8, grid_points = {points} /
&load {load} /
{more}
"""
ONE = f"pbar_over_pstar = {LOAD}"
# Load, and other groups. {area} and {gap} are those of the one load.
CASES = {
    "one load": (ONE, ""),
    "eleven loads": (f"pbar_over_pstar = {ELEVEN}", ""),
    "by area": ("contact_area_fraction = {area}", ""),
    "by gap": ("mean_gap_over_amplitude = {gap}", ""),
    "largest stress": (ONE, "&stress nu = 0.3 /"),
    "section of 128 x 64": (ONE, "&stress nu = 0.3, largest = f, section = 'x', depth_to = 0.1, depth_steps = 64 /\n"
                            "&output line_points = 128 /"),
    "plane of 128 x 128": (ONE, "&stress nu = 0.3, largest = f, planes = t, depths = 0.01 /\n"
                           "&output map_points = 128 /"),
    "interface": (ONE, "&interface resistivity1 = 1, resistivity2 = 1 /"),
    "slip of three loads": (ONE, "&interface friction = 0.5, nu = 0.3, tangential_over_normal = 0.1, 0.2, 0.4 /"),
    "first yield": ("yield = 1", "&stress nu = 0.3, largest = f, yield_stress = 0.1 /"),
}


def run(program, folder, text):
    """Processor time of the program [s], and the first row of its summary by the names of the columns."""
    deck = pathlib.Path(folder, "case.nml")
    deck.write_text(text, encoding="utf-8")
    times = []
    for _ in range(RUNS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, str(deck), "--quiet", "--output", folder], check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    table = Table(pathlib.Path(folder, "case.summary.dat"))
    return min(times), dict(zip(table.columns, table.rows()[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", 1)[0])
    parser.add_argument("--program", required=True, help="wavycon")
    parser.add_argument("--points", type=int, default=1024, help="along a side (1024)")
    given = parser.parse_args()
    print(f"# Times of {given.points} x {given.points} points over one load at P = {LOAD}, a column for each seed.")
    print("#" + f"{'case[word]':>23}" + "".join(f"{f'seed_{seed}[-]':>13}" for seed in SEEDS))
    rows = {name: [] for name in CASES}
    with tempfile.TemporaryDirectory() as folder:
        for seed in SEEDS:
            facts = {"points": given.points, "wave": 16/given.points, "seed": seed}
            for name, (load, more) in CASES.items():
                time, row = run(given.program, folder, DECK.format(**facts, load=load.format(**facts), more=more))
                one = facts.setdefault("one", time)
                facts.setdefault("area", row["contact_area_fraction"])
                facts.setdefault("gap", row["mean_gap_over_amplitude"])
                if name == "first yield":
                    own = f"pbar_over_pstar = {row['pbar_over_pstar']}"
                    one, _ = run(given.program, folder, DECK.format(**facts, load=own, more=""))
                rows[name].append(time/one)
                print(f"option_costs.py: seed {seed}, {name}: {time:.3f} s", file=sys.stderr)
    for name, ratios in rows.items():
        print(f"{name.replace(' ', '_'):>24}" + "".join(f"{ratio:13.2f}" for ratio in ratios))


if __name__ == "__main__":
    main()
