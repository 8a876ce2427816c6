"""Balls with adhesion against the closed form of Johnson, Kendall and Roberts."""
import math

from common import Table, complaints_about, run, write

FORCES = 100
# Relative to the larger of force and pull-off force, to the area and to the two parts of the approach.
ROUNDING = 1e-11
# Complaints of a case.
SHOWN = 3


def force_of(a, radius, e_star, work):
    """The force of a contact of the radius a."""
    return 4*e_star*a**3/(3*radius) - math.sqrt(8*math.pi*work*e_star*a**3)


def campaign(settings, work_folder):
    """Balls of random radius, modulus and work of adhesion, each under 100 forces from 1 - 1e-10 of pull-off on."""
    part = settings.part("balls with adhesion")
    for name, stream, _ in settings.cases("adhesion", ("ball",), settings.amount(50, 4)):
        radius, e_star = 10.0**stream.uniform(-6, 3), 10.0**stream.uniform(-3, 11)
        work = e_star*radius*10.0**stream.uniform(-9, -2)
        pull = 1.5*math.pi*work*radius
        near = [-pull*(1.0 - 10.0**stream.uniform(-10, 0)) for _ in range(FORCES//2)]
        forces = near + [pull*10.0**stream.uniform(-6, 6) for _ in range(FORCES - len(near))]
        files = {"deck.nml": f"&surface kind = 'ball', radius = {radius!r} /\n&material e_star = {e_star!r} /\n"
                             f"&load force = {', '.join(map(repr, forces))} /\n"
                             f"&interface work_of_adhesion = {work!r} /\n&method grid_points = 32 /\n"}
        write(files, work_folder)
        outcome = run([settings.program, "deck.nml", "--output", "results", "--quiet"], work_folder)
        complaints = complaints_about(outcome, (0, 2))
        table = work_folder/"results"/"deck.adhesion.dat"
        rows = [row for row in Table(table).records() if row["load"] != "0"] if table.exists() else []
        stable = [row for row in rows if row["point"] == "stable"]
        if [int(row["load"]) for row in stable] != list(range(1, FORCES + 1)):
            complaints.append(f"{len(stable)} stable contacts of {FORCES} forces")
        for row in rows:
            given = forces[int(row["load"]) - 1]
            a = math.sqrt(float(row["contact_area"])/math.pi)
            parts = a*a/radius, math.sqrt(2*math.pi*work*a/e_star)
            part.limit("force", abs(force_of(a, radius, e_star, work) - given)/max(abs(given), pull), ROUNDING,
                       complaints, f"a force {given!r} has the contact radius {a!r}")
            part.limit("approach", abs(float(row["approach"]) - parts[0] + parts[1])/sum(parts), ROUNDING, complaints,
                       f"at a force {given!r} the approach is {row['approach']}")
            # On the stable branch the force rises with the radius; on the next one the approach does.
            known = math.pi*work*radius**2/(8*e_star)
            if row["point"] != ("stable" if a**3 >= 9*known else "stable_by_approach" if a**3 >= known else "unstable"):
                complaints.append(f"a radius {a!r} under {given!r} is {row['point']}")
        part.count(name, complaints[:SHOWN], files)
    return part
