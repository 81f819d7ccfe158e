"""Tests threads that each have a locator and run concurrently, and threads that share a locator and
run one after another."""

import os
import threading
import time

import pytest

import dotpose

FRAMES = 60


def locate_all(locator, images, results):
    results.append([locator.locate(image)._bits for image in images])


def run(locators, images):
    """Locates the images with each locator in its own thread. Returns the results and the time in
    seconds."""
    results = []
    threads = [
        threading.Thread(target=locate_all, args=(locator, images, results))
        for locator in locators
    ]
    start = time.perf_counter()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results, time.perf_counter() - start


@pytest.fixture(scope="module")
def images():
    frames = dotpose.simulate(20, seed=8, width_px=640, height_px=480)
    return [frame.image for frame in frames] * (FRAMES // 20)


def test_threads_with_a_locator_each_get_the_same_bits(images):
    (expected,), _ = run([dotpose.Locator("anoto")], images)
    results, _ = run([dotpose.Locator("anoto") for _ in range(4)], images)
    assert results == [expected] * 4


def test_threads_may_share_a_locator(images):
    (expected,), _ = run([dotpose.Locator("anoto")], images)
    shared = dotpose.Locator("anoto")
    results, _ = run([shared] * 4, images)
    assert results == [expected] * 4


def test_the_interpreter_goes_on_while_a_thread_locates():
    """Another thread keeps recording the time while a frame is being located."""
    image = dotpose.simulate(1, seed=8, width_px=4096, height_px=4096)[0].image
    locator = dotpose.Locator("anoto")
    noted = []
    stop = threading.Event()

    def note():
        while not stop.wait(0.0002):
            noted.append(time.perf_counter())

    noter = threading.Thread(target=note)
    noter.start()
    shares = []
    for _ in range(20):
        start = time.perf_counter()
        assert locator.locate(image).dots_seen
        end = time.perf_counter()
        shares += [(moment - start) / (end - start) for moment in noted if start < moment < end]
        noted.clear()
    stop.set()
    noter.join()
    # If `locate` held the GIL, the other thread would record times only before and after the call.
    assert sum(0.2 < share < 0.8 for share in shares) >= 5


def cores_of_processes(images):
    """Returns the number of cores used by two processes that run at the same time."""
    start = time.perf_counter()
    children = []
    for _ in range(2):
        child = os.fork()
        if child == 0:
            locate_all(dotpose.Locator("anoto"), images, [])
            os._exit(0)
        children.append(child)
    usages = [os.wait4(child, 0)[2] for child in children]
    seconds = time.perf_counter() - start
    return sum(usage.ru_utime + usage.ru_stime for usage in usages) / seconds


@pytest.mark.skipif("DOTPOSE_TIMES" not in os.environ, reason="times only with DOTPOSE_TIMES=1")
@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="needs two cores")
def test_two_threads_use_two_cores(images):
    """The CPU time of two threads increases faster than wall-clock time, which is impossible if
    they hold the GIL. On a busy machine, the test waits until cores are free."""
    by_processes = 0.0
    for _ in range(20):
        cpu = time.process_time()
        _, seconds = run([dotpose.Locator("anoto"), dotpose.Locator("anoto")], images)
        by_threads = (time.process_time() - cpu) / seconds
        if by_threads > 1.3:
            return
        by_processes = max(by_processes, cores_of_processes(images))
    if by_processes < 1.3:
        pytest.skip(f"the machine is busy: two processes used {by_processes:.2f} cores")
    pytest.fail(f"two threads used {by_threads:.2f} cores, two processes {by_processes:.2f}")
