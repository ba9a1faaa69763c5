#!/usr/bin/env python3
"""tip.py [SPECIES] [OUT.svg]: pulls the tip of a tree's trunk aside, lets go, and plots how it swings and at which frequencies (gnuplot; the picture's
form is by its name: .svg, .png with gnuplot's cairo). Needs an installed bough and numpy."""
import subprocess
import sys

import bough
import numpy as np

name = sys.argv[1] if len(sys.argv) > 1 else "apple"
picture = sys.argv[2] if len(sys.argv) > 2 else "tip.svg"
step, seconds = 1 / 60, 20

tree = bough.convert(bough.grow(name, bodies=1000, seed=1))
scene = bough.Scene()  # no wind: nothing but the wood's own damping
scene.add(tree)
run = bough.Simulation(scene, step=step, pulls=True)
tip = np.flatnonzero(tree.levels == 0)[-1]  # the trunk's last body
end = [0, 0, tree.sizes[tip, 0]]

rest, deflection = run.tips[tip], []
while run.step().time < seconds:
    if len(deflection) < 1 / step:  # a force that grows for a second, then is gone: slow, so that the trunk bends as a whole
        run.pull(tip, end, [20 * len(deflection) * step, 0, 0])
    deflection.append((run.tips[tip] - rest)[0])  # [m] along the pull
deflection = np.array(deflection)
free = deflection[int(1 / step):]
spectrum = np.abs(np.fft.rfft(free, 8 * len(free))) * 2 / len(free)  # [m] means over the time; it has died away by the end: no window
frequency = np.fft.rfftfreq(8 * len(free), step)
peak = frequency[np.argmax(spectrum)]
print(f"{name}: {len(tree)} bodies, {1000 * np.abs(free).max():.1f} mm, strongest at {peak:.2f} Hz")

time = step * np.arange(1, len(deflection) + 1)
blocks = "\n".join(f"${block} << END\n" + "\n".join(f"{a:.6g} {1000 * b:.6g}" for a, b in zip(x, y)) + "\nEND"
                   for block, x, y in (("swing", time, deflection), ("spectrum", frequency, spectrum)))
terminal = "svg" if picture.endswith(".svg") else "pngcairo"
subprocess.run(["gnuplot"], check=True, text=True, input=f"""{blocks}
set terminal {terminal} size 900,700 background 'white'
set output '{picture}'
set multiplot layout 2,1
set grid
set title "{name}, {len(tree)} bodies: the tip of the trunk, pulled aside for a second"
set xlabel "s"
set ylabel "mm"
plot $swing with lines notitle
set title "its frequencies, once let go: {peak:.2f} Hz is the strongest"
set xlabel "Hz"
set ylabel "mm"
set xrange [0:5]
plot $spectrum with lines notitle
""")
