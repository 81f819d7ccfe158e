"""Tests that no memory is leaked over many frames. DOTPOSE_LEAK_FRAMES sets the number of frames
(100,000 in scripts/nightly)."""

import gc
import os
import sys

import numpy as np

import dotpose

FRAMES = int(os.environ.get("DOTPOSE_LEAK_FRAMES", "4000"))


def resident_kb():
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


def use_all_of(fix, tracker, time_us):
    """Reads the results of a frame as a program would, and sometimes draws the picture."""
    fix.covariance, fix.section, fix.cell, fix.other, fix.message, repr(fix)
    track = tracker.update(time_us, fix)
    track.covariance, track.events
    if time_us % 50 == 0:
        fix.dots, fix.draw().svg


def test_no_leak_over_many_frames():
    images = [frame.image for frame in dotpose.simulate(10, seed=4)]
    images.append(np.full((120, 188), 200, np.uint8))
    locator = dotpose.Locator()
    tracker = dotpose.Tracker()
    follower = dotpose.Follower()

    def run(first, count):
        for index in range(first, first + count):
            image = images[index % len(images)]
            use_all_of(locator.locate(image, tracker.predict(index)), tracker, index)
            if index % 10 == 0:
                follower.follow(image, index * 1000)
            if index % 100 == 0:
                dotpose.Locator(keep_stages=True).locate(image).dots
                try:
                    locator.locate(None)
                except TypeError:
                    pass

    run(0, 1000)  # Excludes memory that is allocated once.
    gc.collect()
    references = sum(sys.getrefcount(image) for image in images)

    def growth_kb():
        before = resident_kb()
        run(1000, FRAMES)
        locator.locate(images[-1])
        gc.collect()
        return resident_kb() - before

    # The heap may still grow in the first round. Only a leak causes growth in both rounds.
    grown = min(growth_kb(), growth_kb())
    print(f"{FRAMES} frames: {grown} KB more")
    # A leaked Fix takes 400 bytes, a leaked image 22 KB.
    assert grown < 512 + FRAMES * 0.05
    # A locator keeps a reference to its newest image.
    assert sum(sys.getrefcount(image) for image in images) <= references + 1
