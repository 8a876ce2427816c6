"""Area and approach grow with the load: of the energy's minimum on a grid the approach is the slope over the load, and
contact grows where bodies are pressed together. With free edges, repeated, and with a hardness."""
from honest_estimates import patch
from rough_surfaces import map_text
from summaries import solve

LOADS = 12
# Relative rounding, and what the residual leaves.
SOLVED = 1e-6
KINDS = ("free edges", "repeated", "hardness", "free edges and hardness")


def complaints_of(rows):
    """What falls from a load to the next heavier one."""
    words = []
    for light, heavy in zip(rows, rows[1:]):
        for name in ("approach", "contact_area", "contact_area_counted_fraction"):
            before, behind = float(light.words[name]), float(heavy.words[name])
            if not behind >= before - SOLVED*abs(before):
                words.append(f"{name} falls from {before!r} to {behind!r} at load {heavy.words['load']}")
    return words


def campaign(settings, work):
    """Maps with loads from light to heavy, on their own points."""
    part = settings.part("growing loads")
    for name, stream, kind in settings.cases("growing", KINDS, settings.amount(60, 2)):
        points = stream.choice((32, 48, 64))
        edges = ", edges = 'free'" if kind.startswith("free") else ""
        if edges and stream.random() < 0.5:
            surface, files = f"kind = 'file', file = 'map.dat', height_scale = 0.01{edges}", {
                "map.dat": map_text(patch(stream, points))}
        else:
            surface, files = (f"kind = 'self_affine', points = {points}, rms_slope = 0.1, hurst = 0.8{edges},\n"
                              f"   short_wavelength = {stream.choice((4.0, 8.0))/points!r}, "
                              f"seed = {stream.randint(1, 10**9)}"), {}
        loads = [10.0**(-5.0 + 5.0*(k + stream.random())/LOADS) for k in range(LOADS)]
        material = "e_star = 1.0"
        if kind.endswith("hardness"):
            material += f", hardness = {loads[-1]*10.0**stream.uniform(0.1, 1.5)!r}"
        files["deck.nml"] = (f"&surface {surface} /\n&material {material} /\n"
                             f"&load mean_pressure = {', '.join(map(repr, loads))} /\n&method solver = 'grid' /\n")
        rows, complaints = solve(settings.program, files, work)
        part.count(name, complaints + complaints_of([row for row in rows if row.has_numbers]), files)
    return part
