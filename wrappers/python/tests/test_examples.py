"""Tests that the examples run and print the expected output."""

import json
import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

import dotpose

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def run(name, *arguments):
    """Runs an example as a user would, and returns its output."""
    command = [sys.executable, str(EXAMPLES / name), *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def test_first():
    found, truth, evidence = run("first.py").splitlines()
    numbers = lambda line: [float(word) for word in line.replace(",", "").split() if "." in word]
    assert numbers(found) == pytest.approx(numbers(truth), abs=0.005)
    assert found != truth and "wrong with a probability" in evidence


def test_webcam_is_15_lines_and_follows_a_video(tmp_path, monkeypatch, capsys):
    cv2 = pytest.importorskip("cv2")
    text = (EXAMPLES / "webcam.py").read_text()
    code = [line for line in text.splitlines() if line.strip() and not line.startswith('"""')]
    assert len(code) <= 18 and len(code) - sum("import" in line for line in code) <= 15
    video = tmp_path / "drive.avi"
    frames = dotpose.simulate(10, seed=6, width_px=376, height_px=240, mm_per_px=0.04)
    size = frames[0].image.shape[::-1]
    writer = cv2.VideoWriter(str(video), cv2.VideoWriter_fourcc(*"FFV1"), 10, size)
    assert writer.isOpened()
    for frame in frames:
        writer.write(cv2.cvtColor(frame.image, cv2.COLOR_GRAY2BGR))
    writer.write(cv2.cvtColor(frames[0].image * 0 + 200, cv2.COLOR_GRAY2BGR))
    writer.release()
    # Records calls instead of opening a window, because the test has no screen.
    shown = []
    monkeypatch.setattr(cv2, "imshow", lambda title, image: shown.append(image))
    monkeypatch.setattr(cv2, "waitKey", lambda delay_ms: -1)
    monkeypatch.setattr(sys, "argv", ["webcam.py", str(video)])
    runpy.run_path(str(EXAMPLES / "webcam.py"), run_name="__main__")
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(shown) == 11
    for line, frame in zip(lines, frames):
        assert float(line.split()[0]) == pytest.approx(frame.shot.x_mm, abs=0.01)
    assert "mm" not in lines[-1]
    green = (shown[0][..., 1] > shown[0][..., 2].astype(int) + 50).sum()
    assert green > 1000


def test_figure_13(tmp_path):
    pytest.importorskip("matplotlib")
    out = run("figure_13.py", tmp_path / "figure.png", 2)
    assert "2 samples at each of 121 positions" in out
    # The simulated printer has errors of up to 0.15 mm (paper, Table III).
    assert 50 < float(out.split()[-2]) < 200
    assert dotpose.read_image(tmp_path / "figure.png").shape == (450, 1100)


def test_the_notebook_has_no_outputs_and_runs(tmp_path):
    path = EXAMPLES / "first_steps.ipynb"
    for cell in json.loads(path.read_text())["cells"]:
        assert not cell.get("outputs") and cell.get("execution_count") is None
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    notebook = nbformat.read(path, as_version=4)
    # Uses the current Python interpreter as the kernel, even if another kernel is installed as
    # "python3".
    kernels = tmp_path / "kernels" / "python3"
    kernels.mkdir(parents=True)
    command = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    spec = {"argv": command, "display_name": "Python 3", "language": "python"}
    (kernels / "kernel.json").write_text(json.dumps(spec))
    os.environ["JUPYTER_PATH"] = str(tmp_path)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    kinds = {kind for output in outputs for kind in output.get("data", {})}
    assert {"image/svg+xml", "image/png", "text/plain"} <= kinds
    assert all(output["output_type"] != "error" for output in outputs)
