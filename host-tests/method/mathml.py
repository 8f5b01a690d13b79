"""LaTeX in Markdown, between single or double dollar signs, as MathML that rustdoc passes on to the browser."""
import re

import latex2mathml.converter as conv


def mathml(tex, block):
    number = None
    if block:
        m = re.search(r"\\quad \(([^)]+)\)\s*$", tex.rstrip())
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


def render(text, prepared=lambda text: text):
    """The text with MathML. `prepared` is applied to it first, code set aside."""
    parts = re.split(r"(```.*?```|`[^`\n]*`)", text, flags=re.S)
    # Code spans hold no formulas; put them aside.
    text = "".join(p if i % 2 == 0 else f"\x00{i}\x00" for i, p in enumerate(parts))
    text = prepared(text)
    text = re.sub(r"\$\$(.*?)\$\$", block, text, flags=re.S)
    text = re.sub(r"\$([^$\n]+(?:\n[^$\n]+)?)\$", lambda m: mathml(" ".join(m.group(1).split()), False), text)
    return re.sub("\x00(\\d+)\x00", lambda m: parts[int(m.group(1))], text)


def write(text, path):
    """Writes a page, and names what looks like LaTeX that is left in it."""
    open(path, "w", encoding="utf-8").write(text)
    print(path, len(text), text.count("\n"), text.count("<math"))
    for bad in re.findall(r"\$[^$]{0,40}|\\[a-zA-Z]+", re.sub(r"```.*?```", "", text, flags=re.S)):
        print("left:", bad)
