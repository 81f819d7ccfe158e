"""Measures the overhead of Python per frame relative to C++, in one process.

    python3 cost.py

Python and C++ locate the same image with the same options, in short alternating batches. For each
language, the result is the time of the fastest batch, because other programs disturb the slower
batches.
"""

import time

import dotpose


def cost_us(image, locator, batches=2000, frames=4):
    """Returns the time per frame, in µs: in C++, in Python, and in Python that reads the pose."""
    cpp, python, read = [], [], []
    for _ in range(batches):
        cpp.append(locator._cpp_us(image, frames))
        start = time.perf_counter()
        for _ in range(frames):
            locator.locate(image)
        python.append((time.perf_counter() - start) * 1e6 / frames)
        start = time.perf_counter()
        for _ in range(frames):
            fix = locator.locate(image)
            fix.ok, fix.x_mm, fix.y_mm, fix.theta_rad
        read.append((time.perf_counter() - start) * 1e6 / frames)
    return min(cpp), min(python), min(read)


def main():
    print("frame          C++ [us]  Python adds [us]  with the pose read [us]")
    for width, height in ((188, 120), (640, 480)):
        image = dotpose.simulate(1, seed=3, width_px=width, height_px=height)[0].image
        for code in ("anoto", "auto"):
            cpp, python, read = cost_us(image, dotpose.Locator(code))
            name = f"{width} x {height}, {code}"
            print(f"{name:18} {cpp:8.1f} {python - cpp:8.2f} {read - cpp:8.2f}")


if __name__ == "__main__":
    main()
