"""What the pictures against the load show: summaries, closed forms, details. See facts.py."""
import math
import os

from axes import axis, quoted
from variables import REFERENCE, array_of, mean_pressure_axis, names_of, numbers_in, of_column, put_range, put_scale


# The status of a grid whose errors may be unknown. Those of the paper's series are NaN too, but never known.
UNRESOLVED = 4
LINEAR_LAW = "linear_area_fraction"


def ends_of_bars(tables, factors, name, error_name, head=None):
    """The values of a column, on the axis, and the ends of their error bars as far as these are smaller than the values.

    head: the name of the number of the head by which the errors are to be multiplied.
    """
    ends = []
    for table, factor in zip(tables, factors):
        unit = table.numbers.get(head, 0.0) if head else 1.0
        for block in table.blocks:
            for value, error in zip(block.columns[name], block.columns[error_name]):
                reach = unit*error if unit*error < value else 0.0   # an error that is unknown is NaN
                ends += [factor*(value - reach), factor*(value + reach)]
    return ends


def without_bar(table):
    """Whether a good row has an error as large as the value, or one that is unknown: then it is NaN."""
    return any(code < 10 and error > 0 and error >= value or code == UNRESOLVED and math.isnan(error)
               for block in table.blocks for name in IN_THEORY.values()
               for code, value, error in zip(block.columns["status_code"], block.columns[name],
                                             block.columns[name + "_error"]))


def summary(tables, beside, choice, folder):
    """Summaries: contact area, mean gap and peak pressure against the mean pressure."""
    first = tables[0]
    facts, wide = mean_pressure_axis(tables)

    area = numbers_in(tables, of_column("contact_area_fraction"), "", "area_0", may_be_wide=wide)
    ends = ends_of_bars(tables, area[1], "contact_area_fraction", "contact_area_fraction_error")
    facts += put_scale("area", area, "area", "contact area") + put_range("area", ends, may_be_wide=wide, up_to=1.0)

    gap = numbers_in(tables, of_column("mean_gap"), "Delta", "Delta")
    ends = ends_of_bars(tables, gap[1], "mean_gap", "mean_gap_over_amplitude_error", "Delta")
    facts += put_scale("gap", gap, "mean_gap", "mean gap")
    facts += put_range("gap", ends, may_be_wide=False, up_to=gap[1][0]*first.numbers.get("Delta", 0.0))

    peak = numbers_in(tables, of_column("peak_pressure"), "p*", "p_star", may_be_wide=wide)
    ends = ends_of_bars(tables, peak[1], "peak_pressure", "peak_pressure_over_pstar_error", "p*")
    facts += put_scale("peak", peak, "p_max", "peak pressure") + put_range("peak", ends, may_be_wide=wide)

    facts += array_of("p_star_of", [repr(table.numbers.get("p*", 0.0)) for table in tables])
    facts += array_of("Delta_of", [repr(table.numbers.get("Delta", 0.0)) for table in tables])
    codes = [code for table in tables for code in table.column("status_code")]
    # The paper's series is shown beside converged values: its waves have one shape, whatever their size.
    reference = ""
    if len(tables) == 1 and first.method in ("beale", "series"):
        reference = "table" if "cell_y" in first.numbers else "closed form"
    # gnuplot wants the file even if it plots nothing of it.
    os.symlink(os.path.realpath(REFERENCE), os.path.join(folder, "reference"))
    entries = []
    if reference:
        entries += [("lines ls 31", "converged" if reference == "table" else "closed form"),
                    ("points ls 11", "the paper's series")]
    with_linear_law = len(tables) == 1 and bool(first.column(LINEAR_LAW))
    if with_linear_law:
        entries += [("lines ls 33", "2 p̄/(E* h'), h' the rms slope")]
    if len(tables) > 1:
        entries += [(f"linespoints ls {30 + r}", name) for r, name in enumerate(names_of(tables), 1)]
    if len(tables) == 1 and without_bar(first):
        entries += [("points lc rgb blue pt 6 ps 0.7*mark", "error unknown or as large as the value")]
    entries += [("points ls 42", "not accurate")] if 10 in codes else []
    entries += [("points ls 41", "not solved")] if any(code > 10 for code in codes) else []
    key = "".join(f", keyentry with {style} title key_title[{k}] noenhanced" for k, (style, _) in enumerate(entries, 1))
    facts += array_of("key_title", [quoted(words) for _, words in entries] or ["''"])
    # Heights of title and key in points: the names of several runs may need two rows.
    title_high, key_high = (28, 24*(len(entries) > 0)) if len(tables) == 1 else (0, 40)
    facts += [f"title_high = {title_high}", f"key_high = {key_high}"]
    return "summary", (780, 272 + title_high + key_high), \
        facts + [f"reference = '{reference}'", f"linear_law = {int(with_linear_law)}", f"key_entries = {quoted(key)}"]


# The closed forms of a table of theory, in the order in which they are drawn.
FORMS = {"kuznetsov_mean_gap_over_amplitude": "Kuznetsov, (20)",
         "westergaard_contact_area_fraction": "Westergaard, (7)",
         "westergaard_peak_pressure_over_pstar": "Westergaard, (4)",
         "hertz_line_contact_area_fraction": "Hertz, light loads, (8)",
         "line_crack_contact_area_fraction": "crack, heavy loads, (11)",
         "hertz_contact_area_fraction": "Hertz, light loads, (23)",
         "crack_contact_area_fraction": "crack, heavy loads, (24)",
         "light_longer_contact_area_fraction": "light loads, more terms",
         "closure_longer_contact_area_fraction": "heavy loads, more terms",
         "light_eq29_mean_gap_over_amplitude": "light loads, (29)",
         "crack_mean_gap_over_amplitude": "crack, heavy loads, (30)",
         "light_longer_mean_gap_over_amplitude": "light loads, more terms",
         "closure_longer_mean_gap_over_amplitude": "heavy loads, more terms",
         "light_lattice_mean_gap_over_amplitude": "(29), the whole lattice",
         "hertz_peak_pressure_over_pstar": "Hertz, light loads"}
IN_THEORY = {"area": "contact_area_fraction", "gap": "mean_gap_over_amplitude", "peak": "peak_pressure_over_pstar"}


def theory(tables, beside, choice, folder):
    """Closed forms against the load, normalised, with the points of the summary."""
    table = tables[0]
    facts = put_range("load", table.column("pbar_over_pstar"), up_to=1.0)
    wide = axis(table.column("pbar_over_pstar"))[-1]
    columns, names, last = [], [], [0]
    for panel, ending in IN_THEORY.items():
        found = [(form, words) for form, words in FORMS.items() if form.endswith(ending) and table.column(form)]
        last.append(len(columns) + len(found))
        columns += [quoted(name) for name, _ in found]
        names += [quoted(words) for _, words in found]
        # Asymptotes leave the range of the quantity far from where they hold.
        most = 2.0 if panel == "peak" else 1.0
        numbers = [number for name, _ in found for number in table.column(name) if 0 <= number <= most]
        facts += put_range(panel, numbers + [0.0], may_be_wide=wide and panel != "gap",
                           up_to=None if panel == "peak" else 1.0)
    facts += array_of("form_column", columns) + array_of("form_name", names)
    facts += array_of("forms_before", [str(number) for number in last])
    facts += [f"solved = {int('summary' in beside)}", f"many = {int(len(table.column('pbar_over_pstar')) > 30)}"]
    if "summary" not in beside:
        os.symlink(os.path.realpath(REFERENCE), os.path.join(folder, "summary"))
    return "theory", (860, 400), facts


# Quantities of details: column, label as gnuplot's expression.
DETAILS = (("contact_area_fraction", "'contact area '.area.'/'.area_0"),
           ("mean_gap_over_amplitude", "'mean gap '.mean_gap.'/'.Delta"),
           ("peak_pressure_over_pstar", "'peak pressure '.p_max.'/'.p_star"),
           ("trough_gap_over_amplitude", "'gap at trough '.gap_symbol.'/'.Delta"),
           ("saddle_gap_over_amplitude", "'gap at saddle '.gap_symbol.'/'.Delta"),
           ("saddle_pressure_over_pstar", "'pressure at saddle '.p.'/'.p_star"),
           ("elastic_energy_over_pstar_amplitude", "'elastic energy/('.p_star.Delta.')'"),
           ("perimeter", "perimeter_label"))


def details(tables, beside, choice, folder):
    """Details: a panel for each quantity against the load, and the errors of all."""
    table = tables[0]
    wide = axis(table.column("pbar_over_pstar"))[-1]
    facts = put_range("load", table.column("pbar_over_pstar"), up_to=1.0)
    perimeter = numbers_in(tables, of_column("perimeter"), "cell_x", "")
    facts += [f"perimeter_label = {perimeter[0].label(quoted('perimeter'))}"]
    factors = [perimeter[1][0] if name == "perimeter" else 1.0 for name, _ in DETAILS]
    facts += array_of("column_of", [quoted(name) for name, _ in DETAILS])
    facts += array_of("label_of", [label for _, label in DETAILS])
    facts += array_of("factor_of", [repr(factor) for factor in factors])
    ranges = [axis([factor*number for number in table.column(name)], may_be_wide=wide)
              for (name, _), factor in zip(DETAILS, factors)]
    for name, k in (("low", 0), ("high", 1), ("step", 2)):
        facts += array_of(f"{name}_of", [repr(limits[k]) for limits in ranges])
    facts += array_of("wide_of", [str(int(limits[3])) for limits in ranges])
    facts.append(f"many = {int(len(table.column('pbar_over_pstar')) > 30)}")
    errors = [error for name, _ in DETAILS for error in table.column(name + "_error") if error > 0]
    facts += [f"error_low = {10.0**math.floor(math.log10(max(min(errors, default=0.1), 1e-18)))!r}",
              f"error_high = {10.0**math.ceil(math.log10(max(errors, default=0.5)))!r}"]
    return "details", (780, 700), facts
