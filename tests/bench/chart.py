#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints what rhs.sh measured as a bar chart: python3 chart.py rows.json > chart.svg

A group for each system and a bar for each program, in floors (n calls of glibc's sincos), on a logarithmic scale.
"""

import json
import math
import sys
from xml.sax.saxutils import escape

HEIGHT, BAR, GAP, LEFT, TOP = 300, 11, 22, 50, 60
COLOURS = ["#0b6e4f", "#62b58f", "#b0b7bf", "#8d99a6", "#d9a05b", "#b5651d", "#7a5195", "#5c6670"]

rows = json.load(open(sys.argv[1]))
bars = ["ours", "ours, 8 a pack"]
for row in rows:
    bars += [name for name in row["rivals"] if name not in bars]


def floors(row, bar):
    ns = {"ours": row["ours_ns"], "ours, 8 a pack": row["ours_pack_ns"]}.get(bar, row["rivals"].get(bar))
    return None if ns is None else ns / row["floor_ns"]


values = [v for row in rows for bar in bars if (v := floors(row, bar))]
low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
bottom = TOP + HEIGHT


def height(value):
    return HEIGHT * (math.log10(value) - low) / (high - low)


shapes, x = [], LEFT + GAP
for row in rows:
    start = x
    for bar, colour in zip(bars, COLOURS):
        if (value := floors(row, bar)) is None:
            continue
        h = height(value)
        title = escape(f'{row["system"]}, {bar}: {value:.2f} floors')
        shapes.append(f'<rect x="{x}" y="{bottom - h:.1f}" width="{BAR - 1}" height="{h:.1f}" fill="{colour}"><title>{title}</title></rect>')
        x += BAR
    width = max(x - start, 7 * len(row["system"]))
    shapes.append(f'<text x="{start + width / 2}" y="{bottom + 16}" text-anchor="middle">{escape(row["system"])}</text>')
    x = start + width + GAP
width = x
for k in range(low, high + 1):
    y = bottom - height(10**k)
    shapes.insert(0, f'<line x1="{LEFT}" x2="{width}" y1="{y}" y2="{y}" stroke="{"#444" if k == 0 else "#ddd"}"/>'
                     f'<text x="{LEFT - 6}" y="{y + 4}" text-anchor="end">{10**k:g}</text>')
x = LEFT
for bar, colour in zip(bars, COLOURS):
    shapes.append(f'<rect x="{x}" y="30" width="11" height="11" fill="{colour}"/><text x="{x + 15}" y="40">{escape(bar)}</text>')
    x += 35 + 7 * len(bar)
print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{max(width, x)}" height="{bottom + 30}" font-family="sans-serif" font-size="12">')
print(f'<text x="{LEFT}" y="18">Time of one forward dynamics, in floors: n calls of glibc\'s sincos</text>')
print("\n".join(shapes))
print("</svg>")
