"""The pictures of the chapter "The method": numbers from reimplement.py, drawn as small SVG files without scripts or fonts.

`build.py` puts them into the page as data URIs.
"""
import math
import os
import tempfile
import urllib.parse

import numpy as np

import reimplement as R

HERE = tempfile.mkdtemp()
INK, GRID, PAPER = "#333", "#ddd", "#fcfcfc"
COLOURS = ["#1b6ca8", "#c0392b", "#2e8540", "#8e5ea2", "#b8860b"]


class Svg:
    def __init__(self, width, height):
        self.w, self.h, self.parts = width, height, []

    def add(self, text):
        self.parts.append(text)

    def text(self, x, y, text, anchor="middle", size=13, colour=INK, extra=""):
        self.add(f"<text x='{x:.4g}' y='{y:.4g}' text-anchor='{anchor}' font-size='{size}' fill='{colour}'{extra}>{text}</text>")

    def save(self, name):
        body = "".join(self.parts)
        svg = (
            f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {self.w} {self.h}' width='{self.w}' height='{self.h}' font-family='sans-serif'>"
            f"<rect width='{self.w}' height='{self.h}' rx='6' fill='{PAPER}'/>{body}</svg>"
        )
        with open(os.path.join(HERE, f"picture-{name}.svg"), "w", encoding="utf-8") as f:
            f.write(svg)


class Axes:
    def __init__(self, svg, box, xlim, ylim, xlabel, ylabel, xticks, yticks, logy=False, title=None):
        self.svg, self.box, self.logy = svg, box, logy
        self.xlim, self.ylim = xlim, tuple(math.log10(v) for v in ylim) if logy else ylim
        x0, y0, w, h = box
        for t in xticks:
            x = self.px(t)
            svg.add(f"<path d='M{x:.5g} {y0}v{h}' stroke='{GRID}'/>")
            svg.text(x, y0 + h + 16, f"{t:g}", size=12)
        for t in yticks:
            y = self.py(t)
            svg.add(f"<path d='M{x0} {y:.5g}h{w}' stroke='{GRID}'/>")
            if logy:
                n = round(math.log10(t))
                label = f"10<tspan dy='-5' font-size='9'>{n}</tspan>".replace("-", "\u2212", 0) if n else "1"
            else:
                label = f"{t:g}"
            svg.text(x0 - 6, y + 4, label, "end", 12)
        svg.add(f"<rect x='{x0}' y='{y0}' width='{w}' height='{h}' fill='none' stroke='{INK}'/>")
        svg.text(x0 + w / 2, y0 + h + 34, xlabel)
        cx, cy = x0 - 44, y0 + h / 2
        svg.text(cx, cy, ylabel, extra=f" transform='rotate(-90 {cx:.4g} {cy:.4g})'")
        if title:
            svg.text(x0 + w / 2, y0 - 9, title, size=14)

    def px(self, x):
        return self.box[0] + (x - self.xlim[0]) / (self.xlim[1] - self.xlim[0]) * self.box[2]

    def py(self, y):
        if self.logy:
            y = math.log10(max(y, 1e-300))
        return self.box[1] + self.box[3] - (y - self.ylim[0]) / (self.ylim[1] - self.ylim[0]) * self.box[3]

    def line(self, xs, ys, colour, dash=None, width=2):
        points = " ".join(f"{self.px(x):.1f},{self.py(y):.1f}" for x, y in zip(xs, ys))
        dash = f" stroke-dasharray='{dash}'" if dash else ""
        self.svg.add(f"<polyline points='{points}' fill='none' stroke='{colour}' stroke-width='{width}'{dash}/>")

    def dots(self, xs, ys, colour, r=3.2):
        for x, y in zip(xs, ys):
            self.svg.add(f"<circle cx='{self.px(x):.1f}' cy='{self.py(y):.1f}' r='{r}' fill='{colour}'/>")

    def label(self, x, y, text, colour=INK, anchor="start"):
        self.svg.text(self.px(x), self.py(y), text, anchor, 12, colour)


TABLE1 = (5.06e-6, 2600.0, 7.5e10, 250.0, 10.5, 6.25)


def regular():
    q = R.units(*TABLE1, 2.8)
    law = q["law"]
    svg = Svg(720, 290)
    x = np.linspace(0, 1, 60) ** 4
    left = Axes(svg, (62, 30, 270, 205), (0, 1), (-0.4, 0.8), "indentation x", "force, out of the surface", (0, 0.25, 0.5, 0.75, 1), (-0.4, 0, 0.4, 0.8), title="conservative force against x")
    s = np.sqrt(x)
    left.line(x, 1.25 * s**3 - 0.75 * law.p * s, COLOURS[1])
    left.line((0, 1), (0, 0), INK, width=1)
    left.dots((0,), (0,), COLOURS[1], 4)
    left.label(0.04, 0.07, "slope \u2212\u221e at x = 0", COLOURS[1])
    right = Axes(svg, (432, 30, 270, 205), (0, 1), (-0.4, 1.4), "coordinate s (contact radius)", "slope of the potential", (0, 0.25, 0.5, 0.75, 1), (-0.4, 0, 0.4, 0.8, 1.2), title="dV/ds against s")
    s = np.linspace(0, 1, 60)
    right.line(s, law.V1(s), COLOURS[0])
    right.line((0, 1), (0, 0), INK, width=1)
    right.dots((0,), (0,), COLOURS[0], 4)
    right.label(0.05, 0.1, "a polynomial", COLOURS[0])
    svg.save("regular")


def iterations():
    svg = Svg(720, 310)
    ax = Axes(svg, (78, 20, 440, 230), (0, 10), (1e-16, 1), "iterations", "largest error of y", range(0, 11, 2), (1, 1e-4, 1e-8, 1e-12, 1e-16), logy=True)
    r = R.Radau(9)
    s = 0.7 * r.z
    for i, eta in enumerate((0.05, 0.3, 1.0, 3.0)):
        law = R.Hertz(0.0, eta, 0.0)
        free, loss = 2 * (0.5 - law.V(s)), 1.4 * law.loss(s, False)
        exact, _ = R.newton(r, free, loss, R.Control(1e-13))
        parts = r.w * loss
        it = R.Iteration(free, loss, 0.5 * (np.cumsum(parts) - 0.5 * parts))
        rho = 0.5 * np.max(np.cumsum(parts)) / np.min(exact)
        errors = []
        for _ in range(11):
            errors.append(max(float(np.max(np.abs(it.y - exact))), 1.1e-16))
            it.step(free, loss, -1, r.A)
        ax.line(range(11), errors, COLOURS[i])
        ax.dots(range(11), errors, COLOURS[i])
        bound = [max(errors[0] * rho**k / math.factorial(k), 1.1e-16) for k in range(11)]
        ax.line(range(11), bound, COLOURS[i], "2 4", 1.3)
        y = 60 + 34 * i
        svg.add(f"<path d='M536 {y - 4}h22' stroke='{COLOURS[i]}' stroke-width='2'/>")
        svg.text(564, y, f"\u03b7 = {eta:g}  (\u03f1 = {rho:.2g})", "start", 12)
    svg.add(f"<path d='M536 {60 + 34 * 4 - 4}h22' stroke='{INK}' stroke-width='1.3' stroke-dasharray='2 4'/>")
    svg.text(564, 60 + 34 * 4, "error \u00b7 \u03f1\u1d4f/k!", "start", 12)
    svg.save("iterations")


def phase():
    q = R.units(*TABLE1, 2.8)
    law, E = q["law"], q["E"]
    svg = Svg(720, 300)
    fine, few = R.converged_phases(law, E, 18), R.converged_phases(law, E, 7)
    ax = Axes(svg, (62, 30, 270, 215), (0, 1), (0, 2), "z", "u = y/z", (0, 0.25, 0.5, 0.75, 1), (0, 0.5, 1, 1.5, 2), title="solved for: u(z)")
    bx = Axes(svg, (432, 30, 270, 215), (0, 1), (0, 0.7), "coordinate s", "speed y", (0, 0.25, 0.5, 0.75, 1), (0, 0.2, 0.4, 0.6), title="the motion: y(s)")
    zz = np.linspace(0.0, 1, 60)
    G = R.Gauss(18)
    for i, (name, sol, pts, sign) in enumerate((("approach", fine["approach"], few["approach"], False), ("rebound", fine["rebound"], few["rebound"], True))):
        a = fine["peak"]
        loss = (-4 if sign else 4) * a * law.loss(a * G.m, sign) / G.m**2
        lam = loss * sol[1]
        f = R.Radau(24)
        omega = lambda t: t * t * (1 - t * t) ** 2
        def u(z):
            if z == 0:
                return math.sqrt(2 * a * law.V1(a))
            row = np.array([np.sum(f.w * omega(z * f.z) * R.lagrange(G.z, k, z * f.z)) / z for k in range(18)])
            return math.sqrt(2 * a * law.D(a, a * (1 - z * z)) + row @ lam)
        us = np.array([u(z) for z in zz])
        ax.line(zz, us, COLOURS[i])
        ax.dots(pts[0], pts[1], COLOURS[i])
        bx.line(a * (1 - zz**2), us * zz, COLOURS[i])
        bx.dots(few["peak"] * (1 - pts[0] ** 2), pts[0] * pts[1], COLOURS[i])
    ax.label(0.62, 1.25, "approach", COLOURS[0])
    ax.label(0.22, 0.75, "rebound", COLOURS[1])
    bx.label(0.40, 0.63, "approach", COLOURS[0], "middle")
    bx.label(0.40, 0.30, "rebound", COLOURS[1], "middle")
    svg.save("phase")


def critical():
    scene = (2.5e-6, 2600.0, 7.5e10, 250.0, 10.5, 6.25)
    vc, _ = R.critical(scene, 9, 1e-9)
    unit = R.units(*scene, vc)
    svg = Svg(720, 310)
    ax = Axes(svg, (62, 20, 440, 240), (0, 1.02), (0, 0.8), "coordinate s", "speed y", (0, 0.25, 0.5, 0.75, 1), (0, 0.2, 0.4, 0.6, 0.8))
    for i, (factor, name) in enumerate(((1.15, "15 % faster: rebound"), (1.0, "critical"), (0.85, "15 % slower: capture"))):
        R.trial(scene, vc * factor, 9, 1e-9)
        down, up, law, bottom = R.trial.paths
        colour = COLOURS[(0, 2, 1)[i]]
        q = R.units(*scene, vc * factor)
        # In units of the critical impact, so that the three are comparable.
        fs, fy = math.sqrt(q["L"] / unit["L"]), q["U"] / unit["U"]

        def dense(iv, side):
            turning = side in ("arrive", "leave")
            z, f = np.linspace(0, 1, 16), iv.y / (iv.R.z if turning else 1)
            cards = np.array([R.lagrange(iv.R.z, k, z) for k in range(iv.R.n)])
            s, y = iv.s @ cards, (f @ cards) * (z if turning else 1)
            return (s[::-1], y[::-1]) if side == "arrive" else (s, y)

        s, y = [], []
        for iv, side in down:
            a, b = dense(iv, side)
            s += list(a * fs)
            y += list(b * fy)
        ax.line(s, y, colour)
        ax.dots(s[-1:], y[-1:], colour, 4)
        if i == 1:
            s, y = [0.0], [0.0]
            for iv, _ in up:
                s += list(iv.s)
                y += list(iv.y)
            ax.line(s, y, INK, "6 3", 2)
            x = ax.px(bottom)
            svg.add(f"<path d='M{x:.5g} 20v240' stroke='{INK}' stroke-dasharray='2 3'/>")
            ax.label(bottom + 0.015, 0.76, "minimum of V")
        yy = 60 + 30 * i
        svg.add(f"<path d='M518 {yy - 4}h22' stroke='{colour}' stroke-width='2'/>")
        svg.text(546, yy, name, "start", 12)
    svg.add(f"<path d='M518 146h22' stroke='{INK}' stroke-width='2' stroke-dasharray='6 3'/>")
    svg.text(546, 150, "from rest, against time", "start", 12)
    svg.save("critical")


def convergence():
    svg = Svg(720, 320)
    ax = Axes(svg, (78, 20, 420, 245), (3, 20), (1e-15, 1e-1), "nodes in each phase", "error of e\u00b2", range(4, 21, 4), (1e-2, 1e-5, 1e-8, 1e-11, 1e-14), logy=True)
    scene5 = (2.5e-6, 2600.0, 7.5e10, 250.0, 10.5, 6.25)
    vc, _ = R.critical(scene5, 12, 1e-12)
    cases = []
    q = R.units(5.06e-6, 2600.0, 7.5e10, 0.0, 10.5, 0.0, 2.8)
    cases.append(("no adhesion, 2.8 m/s", q))
    cases.append(("30 m/s", R.units(*TABLE1, 30.0)))
    cases.append(("Table 1: 2.8 m/s", R.units(*TABLE1, 2.8)))
    cases.append(("13 % above critical", R.units(*scene5, 1.13 * vc)))
    for i, (name, q) in enumerate(cases):
        law, E = q["law"], q["E"]
        exact = R.collocation(law, E, 14, 1e-14)["E"]
        ns, errors, estimates = list(range(4, 19)), [], []
        for n in ns:
            got = R.converged_phases(law, E, n)
            errors.append(max(abs(got["E"] - exact) / E, 1.5e-15))
            estimates.append(max(got["estimate"], 1.5e-15))
        ax.line(ns, errors, COLOURS[i])
        ax.dots(ns, errors, COLOURS[i])
        ax.line(ns, estimates, COLOURS[i], "2 4", 1.3)
        yy = 60 + 30 * i
        svg.add(f"<path d='M516 {yy - 4}h22' stroke='{COLOURS[i]}' stroke-width='2'/>")
        svg.text(544, yy, name, "start", 12)
    svg.add(f"<path d='M516 176h22' stroke='{INK}' stroke-width='1.3' stroke-dasharray='2 4'/>")
    svg.text(544, 180, "estimates by (25)", "start", 12)
    svg.save("convergence")


def uri(name):
    with open(os.path.join(HERE, f"picture-{name}.svg"), encoding="utf-8") as f:
        return "data:image/svg+xml;charset=utf-8," + urllib.parse.quote(f.read(), safe=" ='/:;,.-()!*@$?")


def draw_all():
    for draw in (regular, iterations, phase, critical, convergence):
        draw()
