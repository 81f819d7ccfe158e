"""Draws Figure 13 of the paper, the accuracy of x over a page: figure_13.py [FILE [SAMPLES]]."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import dotpose

path = sys.argv[1] if len(sys.argv) > 1 else "figure_13.png"
samples = int(sys.argv[2]) if len(sys.argv) > 2 else 20
protocol = dotpose.run_protocol(samples)

figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
for axis, page, title in zip(axes, (protocol.perfect, protocol.printed), ("perfect", "printed")):
    places_mm = np.array([station.place_mm for station in page.positions])
    error_um = 1000 * np.array([abs(station.x_mm[0]) for station in page.positions])
    order = np.lexsort((places_mm[:, 0], places_mm[:, 1]))
    x_mm, y_mm = np.unique(places_mm[:, 0]), np.unique(places_mm[:, 1])
    colours = axis.pcolormesh(x_mm, y_mm, error_um[order].reshape(len(y_mm), len(x_mm)))
    axis.set(title=f"{title} page", xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    axis.invert_yaxis()
    figure.colorbar(colours, ax=axis, label="accuracy of x [um]")
figure.savefig(path)
worst_um = 1000 * max(abs(station.x_mm[0]) for station in protocol.printed.positions)
print(f"{path}: {samples} samples at each of {len(protocol.printed.positions)} positions, "
      f"worst accuracy of x on the printed page {worst_um:.0f} um")
