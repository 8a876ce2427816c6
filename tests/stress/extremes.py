"""Decks with the smallest and largest allowed numbers: loads, lengths, moduli, harmonics."""
import itertools

from common import Table, complaints_about, files_below, result_complaints, run, write

LOADS = ("1e-90", "1e-12", "1e-9", "1e-6", "1e-3", "0.5", "0.999", "0.999999999", "0.999999999999", "1",
         "1.0000000000000002", "1.5", "1e6", "0")
POWERS = (-12, -6, 0, 6, 12)
TOLERANCE = 1e-9  # of columns that do not depend on units: rounding of lengths and pressures over 24 decades
DIMENSIONLESS = ("pbar_over_pstar", "mean_gap_over_amplitude", "contact_area_fraction", "peak_pressure_over_pstar")


def deck(kind, loads, method="", amplitude="1", wavelength="1", modulus="1"):
    return (f"&surface kind = '{kind}', amplitude = {amplitude}, wavelength = {wavelength} /\n"
            f"&material e_star = {modulus} /\n&load pbar_over_pstar = {', '.join(loads)} /\n&method {method} /\n"
            f"&output lines = t, line_points = 16 /\n")


def decks(quick):
    """Name, deck, and the name of the deck whose dimensionless columns it must repeat."""
    for kind, solver in itertools.product(("wave_1d", "wave_2d"), ("beale", "series", "auto")):
        if kind == "wave_2d" and solver == "auto":
            method = "solver = 'auto', accuracy = 0.1"
            loads = LOADS[3:] if quick else LOADS[1:]
        else:
            method, loads = f"solver = '{solver}'", LOADS
        first = f"{kind}-{solver}"
        yield first, deck(kind, loads, method), None
        for a, w, e in itertools.product(POWERS, POWERS, POWERS):
            # On grids, which take longer, and in the short form fewer of them.
            if (a, w, e) == (0, 0, 0) or solver == "auto" and kind == "wave_2d" and 0 in (a, w, e):
                continue
            if quick and 12 not in (abs(a), abs(w), abs(e)) or quick and (a + w + e) % 24:
                continue
            yield (f"{first}-1e{a}-1e{w}-1e{e}",
                   deck(kind, loads, method, f"1e{a}", f"1e{w}", f"1e{e}"), first)
    for n, solver in itertools.product((1, 7, 60) if quick else range(1, 61), ("beale", "series")):
        for points in sorted({n + 1, 2*n + 1, 10*n} - {1}):
            method = f"solver = '{solver}', harmonics = {n}, constraint_points = {points}"
            yield f"{solver}-{n}-{points}", deck("wave_1d", LOADS, method), None
    for n, solver in itertools.product((1, 6) if quick else (1, 2, 3, 5, 8, 12, 20, 40, 60), ("beale", "series")):
        for points in sorted({n + 1, 2*n, min(10*n, 900//n)}):
            # Bounded work: of 960 unknowns Beale's method would take minutes.
            if n < points <= 4000//n and (solver == "series" or n <= 20):
                method = f"solver = '{solver}', harmonics = {n}, constraint_points = {points}"
                yield f"{solver}-2d-{n}-{points}", deck("wave_2d", ("0.9", "0.3", "1e-6"), method), None
    for power in (2, 9) if quick else range(1, 17):
        yield (f"flat-crest-1e-{power}", f"&surface kind = 'crossed_1d', amplitude1 = 1e-{power}, wavelength1 = 1, "
               "amplitude2 = 1, wavelength2 = 1 /\n&load pbar_over_pstar = 1e-5, 1e-3, 0.05, 0.25, 0.7 /\n"
               "&method accuracy = 0.1 /\n", None)
    # A side of more than 1000 times the other is refused.
    for power in () if quick else (1, 2, 3):
        yield (f"long-cell-1e{power}", "&surface kind = 'crossed_1d', amplitude1 = 1, wavelength1 = 1, amplitude2 = 1, "
               f"wavelength2 = 1e{power} /\n&load pbar_over_pstar = 0.5 /\n&method accuracy = 0.1 /\n", None)


def campaign(settings, work):
    part = settings.part("extreme numbers, run")
    kept = {}
    unsolved = 0
    for name, text, alike in decks(settings.quick):
        folder = work/name
        write({"deck.nml": text}, folder)
        outcome = run([settings.program, "deck.nml", "--output", "results"], folder, patience=60.0)
        # A grid that is too coarse for the load has the status not_accurate, which is right; it is counted.
        complaints = complaints_about(outcome, (0, 2), seconds=20.0)
        unsolved += outcome.status == 2
        complaints += result_complaints(folder, files_below(folder))
        if outcome.status in (0, 2):
            kept[name] = Table(folder/"results"/"deck.summary.dat").records()
            for row, other in zip(kept[name], kept.get(alike, [])):
                for column in DIMENSIONLESS:
                    off = abs(float(row[column]) - float(other[column]))
                    part.limit("units change", off, TOLERANCE, complaints, f"{column} = {row[column]} at P = "
                               f"{row['pbar_over_pstar']}, {other[column]} in other units")
        part.count(name, complaints, {"deck.nml": text})
    part.notes.append(f"{unsolved} with status 2")
    return part
