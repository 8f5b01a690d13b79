"""Makes src/contact/method.md from method.md: LaTeX to MathML, pictures to data URIs, the table of constants; and the guide's page of
equations from examples/guide/source/equations.md.

In this folder: `pip install latex2mathml numpy` in a virtual environment, then `python build.py`. `python reimplement.py`
checks the page: it solves the reference with what the page states.
"""
import re

import constants
import mathml
import pictures

pictures.draw_all()
text = open("method.md", encoding="utf-8").read()
PICTURES = {
'regular':("Left: the force of Table 1 against the indentation has a vertical tangent where contact begins and ends. Right: the slope of the same potential against the coordinate is a polynomial.","Two curves: force against indentation with a vertical tangent at zero, and slope of the potential against the coordinate, a smooth polynomial."),
'iterations':("Largest error of the speed after each iteration, on a regular interval from 0 to 0.7 with nine nodes and Hunt and Crossley's damping. Dotted: the bound of the text.","Errors fall faster than exponentially with the number of iterations; for damping 0.05 four iterations reach rounding, for damping 3 more than ten."),
'phase':("Table 1 with seven nodes in each phase (dots) and with eighteen (lines). The square root of the speed at the peak has vanished from u.","Left: u against z, two smooth falling curves for approach and rebound with seven nodes each. Right: speed against the coordinate, with a vertical tangent at the peak."),
'critical':("Two paths meet at the minimum of the potential: the impact (solid, coming from the left over the peak) and, against time, the departure from rest (dashed). Their speeds there decide.","Speed against coordinate for impacts at 15 percent above, at, and 15 percent below the critical speed, and the path from rest that meets the critical one at the minimum of the potential."),
'convergence':("Error of e² of whole phases, iterated to rounding, against the number of nodes, and its estimate.","Errors fall geometrically with the number of nodes, fastest without adhesion and slowest near the critical speed; the estimates lie mostly above the errors."),
}
for name, (caption, alt) in PICTURES.items():
    mark = f"<!-- picture {name} -->"
    assert mark in text, name
    text = text.replace(mark, f"@@PIC {name}|{alt}|{caption}@@")


table, rows = [], []
for row in constants.C:
    if len(row) == 1:
        rows += ["", row[0], "", "| name | value | where | why |", "| --- | --- | --- | --- |"]
    else:
        name, value, where, why = row
        names = "<br>".join(f"`{n}`" if n.isupper() or "_" in n else n for n in name.split(", "))
        parts_of_value = value.replace("; ", ", ").split(", ") if names.count("<br>") else [value]
        value = "<br>".join(parts_of_value)
        rows.append(f"| {names} | {value} | {where} | {why} |")
text = mathml.render(text, lambda text: text.replace("<!-- constants -->", "\n".join(table + rows)))


def picture(m):
    name, alt, caption = m.group(1).split("|")
    svg = open(f"{pictures.HERE}/picture-{name}.svg", encoding="utf-8").read()
    width, height = re.search(r"width='(\d+)' height='(\d+)'", svg).groups()
    return f'<figure><img src="{pictures.uri(name)}" width="{width}" height="{height}" alt="{alt}"><figcaption>{caption}</figcaption></figure>'


text = re.sub(r"@@PIC (.*?)@@", picture, text)
mathml.write(text, "../../src/contact/method.md")

GUIDE = "../../examples/guide"
equations = open(f"{GUIDE}/source/equations.md", encoding="utf-8").read()
mathml.write(mathml.render(equations), f"{GUIDE}/pages/equations.md")
