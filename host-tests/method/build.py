"""Makes src/contact/method.md from method.md: LaTeX to MathML, pictures to data URIs, the table of constants.

In this folder: `pip install latex2mathml numpy` in a virtual environment, then `python build.py`. `python reimplement.py`
checks the page: it solves the reference with what the page states.
"""
import re

import latex2mathml.converter as conv

import constants
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


def mathml(tex, block):
    number = None
    if block:
        m = re.search(r"\\quad \((\d+)\)\s*$", tex.rstrip())
        if m:
            number, tex = m.group(1), tex[: m.start()]
    out = conv.convert(tex.strip(), display="block" if block else "inline")
    out = out.replace(' xmlns="http://www.w3.org/1998/Math/MathML"', "").replace(' display="inline"', "")
    out = re.sub(r"^<math([^>]*)><mrow>(.*)</mrow></math>$", r"<math\1>\2</math>", out)
    for c in "mi mn mo".split():
        out = re.sub(rf"<mrow>(<{c}[^>]*>[^<]*</{c}>)</mrow>", r"\1", out)
    out = re.sub(r">([^<]*)<", lambda m: ">" + m.group(1).replace("|", "&#x7C;").replace("*", "&#x2A;").replace("_", "&#x5F;").replace("'", "&#x2032;") + "<", out)
    out = out.replace('<mo stretchy="false">&#x0007C;</mo>', "<mo>&#x0007C;</mo>").replace("<mo>&#x0007C;</mo>", '<mo stretchy="false" lspace="0" rspace="0">&#x7C;</mo>')
    # A prime beside its letter, in the font of the text: as a superscript it nearly vanishes where no mathematical font is installed.
    out = re.sub(r"<msup>(<mi>[^<]*</mi>)<m[io]>&#x0*2032;</m[io]></msup>", r'<mrow>\1<mtext style="font-family:serif">′</mtext></mrow>', out)
    out = out.replace('<mi>V</mi><mtext style="font-family:serif">', '<mi>V</mi><mspace width="0.12em"/><mtext style="font-family:serif">')
    out = re.sub(r"<msup>(<mi>[^<]*</mi>)(?:<mrow>)?<m[io]>&#x0*2033;</m[io]>(?:</mrow>)?</msup>", r'<mrow>\1<mtext style="font-family:serif">″</mtext></mrow>', out)
    if number:
        out = out[: -len("</math>")] + f'<mspace width="2em"/><mtext>({number})</mtext></math>'
    return re.sub(r"<mspace ([^>]*)/>", r"<mspace \1></mspace>", out)


def block(m):
    return "<p>" + mathml(" ".join(m.group(1).split()), True) + "</p>"


parts = re.split(r"(```.*?```|`[^`\n]*`)", text, flags=re.S)
# Code spans hold no formulas; put them aside.
text = "".join(p if i % 2 == 0 else f"\x00{i}\x00" for i, p in enumerate(parts))
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
text = text.replace("<!-- constants -->", "\n".join(table + rows))
text = re.sub(r"\$\$(.*?)\$\$", block, text, flags=re.S)
text = re.sub(r"\$([^$\n]+(?:\n[^$\n]+)?)\$", lambda m: mathml(" ".join(m.group(1).split()), False), text)
text = re.sub("\x00(\\d+)\x00", lambda m: parts[int(m.group(1))], text)


def picture(m):
    name, alt, caption = m.group(1).split("|")
    svg = open(f"{pictures.HERE}/picture-{name}.svg", encoding="utf-8").read()
    width, height = re.search(r"width='(\d+)' height='(\d+)'", svg).groups()
    return f'<figure><img src="{pictures.uri(name)}" width="{width}" height="{height}" alt="{alt}"><figcaption>{caption}</figcaption></figure>'


text = re.sub(r"@@PIC (.*?)@@", picture, text)
open("../../src/contact/method.md", "w", encoding="utf-8").write(text)
print(len(text), text.count("\n"), text.count("<math"))
for bad in re.findall(r"\$[^$]{0,40}|\\[a-zA-Z]+", re.sub(r"```.*?```", "", text, flags=re.S)):
    print("left:", bad)
