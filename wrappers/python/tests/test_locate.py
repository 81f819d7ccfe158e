"""Tests Locator, Fix, Prediction, and their arrays."""

import math

import numpy as np
import pytest

import dotpose


def test_finds_the_true_pose(frames):
    locator = dotpose.Locator()
    for frame in frames:
        fix = locator.locate(frame.image)
        assert fix and fix.ok and fix.status == "ok"
        assert fix.x_mm == pytest.approx(frame.shot.x_mm, abs=0.005)
        assert fix.y_mm == pytest.approx(frame.shot.y_mm, abs=0.005)
        turn = math.remainder(fix.theta_rad - frame.shot.theta_rad, 2 * math.pi)
        assert abs(turn) < 0.002
        assert fix.section == frame.shot.section
        assert fix.code == "anoto" and locator.code == "anoto"
        assert 0 < fix.p_wrong < 1e-9
        assert fix.spacing_px == pytest.approx(0.508 / 0.046, rel=0.01)
        assert fix.attempt == "first" and fix.surface in ("even", "uneven")


def test_covariance_is_in_mm_and_rad(frames):
    fix = dotpose.Locator().locate(frames[0].image)
    covariance = fix.covariance
    assert covariance.shape == (3, 3) and covariance.dtype == np.float64
    assert (covariance == covariance.T).all() and (np.linalg.eigvalsh(covariance) > 0).all()
    # The standard deviations are about 1 µm and 0.02 degrees (docs/accuracy.md).
    assert 0.0003 < math.sqrt(covariance[0, 0]) < 0.003
    assert 0.0001 < math.sqrt(covariance[2, 2]) < 0.001
    half = dotpose.Locator(spacing_mm=0.254).locate(frames[0].image)
    assert half.x_mm == pytest.approx(fix.x_mm / 2) and half.x_grid == fix.x_grid
    np.testing.assert_allclose(half.covariance[:2, :2], covariance[:2, :2] / 4)
    np.testing.assert_allclose(half.covariance[:2, 2], covariance[:2, 2] / 2)


def test_a_frame_without_a_fix_is_false_and_says_why():
    fix = dotpose.Locator().locate(np.full((120, 188), 200, np.uint8))
    assert not fix and not fix.ok and fix.status == "no_contrast"
    assert fix.message == "the image has no dark marks on a lighter background"
    assert math.isnan(fix.x_mm) and math.isnan(fix.y_mm) and math.isnan(fix.theta_rad)
    assert np.isnan(fix.covariance).all()
    assert fix.section is None and fix.cell is None and fix.p_wrong == 1
    assert fix.dots.shape[1] == 2 and "<svg" in fix.draw().svg
    with pytest.raises(dotpose.BadArgument, match="ok"):
        dotpose.Prediction.like(fix)


def test_rows_may_lie_apart_and_in_any_order(frames):
    image = frames[0].image
    wanted = dotpose.Locator().locate(image)._bits
    wide = np.zeros((120, 300), np.uint8)
    wide[:, 7:195] = image
    assert dotpose.Locator().locate(wide[:, 7:195])._bits == wanted
    upside_down = image[::-1].copy()
    assert dotpose.Locator().locate(upside_down[::-1])._bits == wanted
    readonly = image.copy()
    readonly.flags.writeable = False
    assert dotpose.Locator().locate(readonly)._bits == wanted


def test_the_pixels_are_not_copied(frames):
    # A view does not copy pixels, so it can be larger than the available memory.
    huge = np.broadcast_to(np.uint8(200), (1 << 40, 100))
    with pytest.raises(TypeError, match="not contiguous"):
        dotpose.Locator().locate(huge)
    rows = np.lib.stride_tricks.as_strided(frames[0].image, (1 << 40, 188), (0, 1))
    assert dotpose.Locator().locate(rows).status == "image_too_large"


@pytest.mark.parametrize(
    "wrong, words",
    [
        (np.zeros((120, 188)), "float64"),
        (np.zeros((120, 188), np.int8), "int8"),
        (np.zeros((120, 188), bool), "bool"),
        (np.zeros((120, 188), np.uint16), "uint16"),
        (np.zeros((120, 188, 3), np.uint8), r"\(120, 188, 3\).*cvtColor"),
        (np.zeros(188, np.uint8), r"\(188,\)"),
        (np.zeros((120, 376), np.uint8)[:, ::2], "ascontiguousarray"),
        (np.zeros((120, 188), np.uint8)[:, ::-1], "ascontiguousarray"),
        (np.zeros((188, 120), np.uint8).T, "ascontiguousarray"),
        ([[1, 2], [3, 4]], "a list.*asarray"),
        (b"bytes", "a bytes"),
        (None, "a NoneType"),
    ],
)
def test_what_is_no_image_is_a_type_error_that_says_what_is_wanted(wrong, words):
    with pytest.raises(TypeError, match="uint8 with the shape .height, width.") as raised:
        dotpose.Locator().locate(wrong)
    assert raised.match(words)
    with pytest.raises(TypeError, match="uint8 with the shape"):
        dotpose.Follower().follow(wrong, 0)


@pytest.mark.parametrize(
    "shape, status",
    [((0, 0), "image_too_small"), ((1, 1), "image_too_small"), ((63, 200), "image_too_small"),
     ((64, 4097), "image_too_large")],
)
def test_sizes_that_cannot_be_located_are_a_status(shape, status):
    assert dotpose.Locator().locate(np.zeros(shape, np.uint8)).status == status


def test_dots_lie_on_dark_pixels(frames):
    locator = dotpose.Locator()
    for frame in frames:
        dots = locator.locate(frame.image).dots
        assert dots.shape[1] == 2 and len(dots) > 100
        u, v = np.rint(dots).astype(int).T
        assert frame.image[v, u].mean() < frame.image.mean() - 30


def test_dots_are_where_a_lens_shows_them():
    frame = dotpose.simulate(1, seed=9, k_per_px2=-1e-5)[0]
    camera = dotpose.Camera(188, 120, -1e-5)
    fix = dotpose.Locator(camera=camera).locate(frame.image)
    assert fix.x_mm == pytest.approx(frame.shot.x_mm, abs=0.005)
    u, v = np.rint(fix.dots).astype(int).T
    outer = np.hypot(u - 93.5, v - 59.5) > 80
    assert outer.sum() > 10
    assert frame.image[v[outer], u[outer]].mean() < frame.image.mean() - 30


def test_dots_and_picture_are_those_of_the_newest_fix(frames, tmp_path):
    locator = dotpose.Locator()
    first = locator.locate(frames[0].image)
    second = locator.locate(frames[1].image)
    with pytest.raises(dotpose.Error, match="keep_stages"):
        first.dots
    picture = second.draw(tmp_path / "frame.svg", title="second & last")
    assert (tmp_path / "frame.svg").read_text() == picture.svg == picture._repr_svg_()
    assert "second &amp; last" in picture.svg
    with pytest.raises(dotpose.Error, match="no/folder"):
        picture.save("/no/folder/x.svg")


def test_kept_stages_stay(frames):
    locator = dotpose.Locator("anoto", keep_stages=True)
    fixes = [locator.locate(frame.image) for frame in frames]
    newest = [dotpose.Locator("anoto").locate(frame.image) for frame in frames]
    for kept, new in zip(fixes, newest):
        assert (kept.dots == new.dots).all()
        assert kept.draw().svg == new.draw().svg
        assert kept._bits == new._bits


def test_an_image_that_changed_has_no_dots(frames):
    image = frames[0].image.copy()
    fix = dotpose.Locator().locate(image)
    image[:] = frames[1].image
    with pytest.raises(dotpose.Error, match="changed"):
        fix.dots


def test_stages_of_tracked_frames_and_of_any_code(frames):
    shot = dotpose.draw_shots(1, seed=5)[0]
    locator = dotpose.Locator()
    fix = locator.locate(shot.render())
    shot.move(0.2, 0.1)
    tracked = locator.locate(shot.render(), dotpose.Prediction.like(fix))
    assert tracked.attempt == "tracked" and len(tracked.dots) > 100
    after = locator.locate(shot.render(), dotpose.Prediction.like(tracked))
    assert after.attempt == "tracked"


def test_predictions_move_and_turn():
    shot = dotpose.draw_shots(1, "clean", seed=5)[0]
    locator = dotpose.Locator("anoto")
    prediction = dotpose.Prediction.like(locator.locate(shot.render()))
    assert prediction.sigma_mm == pytest.approx(0.508 / 5, rel=1e-3)
    prediction.sigma_mm = 0.02
    prediction.sigma_theta_rad = 0.005
    assert prediction.sigma_mm == pytest.approx(0.02, abs=1e-5)
    shot.x_mm += 3.0
    shot.y_mm -= 2.0
    shot.theta_rad += 0.1
    image = shot.render()
    assert locator.locate(image, prediction).attempt == "first"
    moved = prediction.moved(3.0, -2.0, 0.1)
    assert moved.sigma_mm == prediction.sigma_mm
    assert locator.locate(image, moved).attempt == "tracked"


@pytest.mark.parametrize("code", ["anoto", "libdots", "microdots"])
def test_the_code_is_found(code):
    frames = dotpose.simulate(4, seed=12, code=code)
    locator = dotpose.Locator()
    fixes = [locator.locate(frame.image) for frame in frames]
    given = dotpose.Locator(code)
    for fix, frame in zip(fixes, frames):
        assert given.locate(frame.image).x_mm == pytest.approx(frame.shot.x_mm, abs=0.01)
    assert locator.code == code and fixes[-1].code == code and given.code == code


def test_reference_point_moves_the_pose(frames):
    image, shot = frames[0].image, frames[0].shot
    fix = dotpose.Locator(reference_px=(93.5 + 20, 59.5)).locate(image)
    along = 20 * 0.046
    assert fix.x_mm == pytest.approx(shot.x_mm + along * math.cos(shot.theta_rad), abs=0.01)
    assert fix.y_mm == pytest.approx(shot.y_mm + along * math.sin(shot.theta_rad), abs=0.01)


def test_options_have_the_defaults_of_cpp_and_are_checked(frames):
    options = dotpose.Options()
    assert (options.min_dots, options.min_contrast) == (40, 0)
    assert (options.max_p_wrong, options.max_bit_errors) == (1e-9, 0.18)
    assert options.bits_per_error == 0
    assert (options.effort, options.decoder) == ("twice", "all")
    assert dotpose.Options(min_dots=60).min_dots == 60
    with pytest.raises(TypeError, match="min_dot"):
        dotpose.Options(min_dot=60)
    with pytest.raises(dotpose.BadArgument, match="device, once, twice"):
        dotpose.Options(effort="thrice")
    image = frames[0].image
    with pytest.raises(dotpose.BadArgument, match="bits_per_error"):
        dotpose.Locator(options=dotpose.Options(bits_per_error=-2))
    strict = dotpose.Locator(options=dotpose.Options(max_p_wrong=1e-60))
    assert strict.locate(image).status == "not_certain"
    pale = dotpose.Locator(options=dotpose.Options(min_contrast=250))
    assert pale.locate(image).status == "no_contrast"
    with pytest.raises(dotpose.BadArgument, match="min_contrast"):
        dotpose.Locator(options=dotpose.Options(min_contrast=256))


def test_a_measured_error_rate_makes_small_views_certain():
    small = dotpose.simulate(60, seed=5, width_px=96, height_px=96)

    def new_locator(bits_per_error):
        return dotpose.Locator(options=dotpose.Options(bits_per_error=bits_per_error), code="anoto")

    def located(locator):
        return sum(locator.locate(frame.image).ok for frame in small)

    assert located(new_locator(-1)) > 2 * located(new_locator(0))


def test_dots_of_a_fix_are_found_with_the_error_rate_measured_before_it():
    small = dotpose.simulate(60, seed=5, width_px=96, height_px=96)
    measuring, unknown = (
        dotpose.Locator(options=dotpose.Options(bits_per_error=n), code="anoto") for n in (-1, 0)
    )
    helped = 0
    for frame in small:
        fix = measuring.locate(frame.image)
        if fix.ok and not unknown.locate(frame.image).ok:
            helped += 1
            assert len(fix.dots) > 60
    assert helped > 20


def test_errors_are_a_family():
    assert issubclass(dotpose.Error, RuntimeError)
    assert issubclass(dotpose.BadArgument, dotpose.Error) and issubclass(dotpose.BadArgument, ValueError)
    assert issubclass(dotpose.ImageTooLarge, dotpose.Error)
    with pytest.raises(ValueError, match="'nota' is none of auto, anoto"):
        dotpose.Locator("nota")
    for spacing in (0, -1, math.nan, 1e9):
        with pytest.raises(dotpose.BadArgument, match="spacing_mm"):
            dotpose.Locator(spacing_mm=spacing)


def test_image_files(tmp_path, frames):
    for name in ("frame.png", "frame.pgm"):
        dotpose.write_image(tmp_path / name, frames[0].image)
        again = dotpose.read_image(str(tmp_path / name))
        assert again.dtype == np.uint8 and (again == frames[0].image).all()
    with pytest.raises(dotpose.Error, match="none.png"):
        dotpose.read_image(tmp_path / "none.png")
    with pytest.raises(dotpose.BadArgument, match="png"):
        dotpose.write_image(tmp_path / "frame.gif", frames[0].image)
    (tmp_path / "huge.pgm").write_bytes(b"P5\n90000 90000\n255\n")
    with pytest.raises(dotpose.ImageTooLarge) as raised:
        dotpose.read_image(tmp_path / "huge.pgm")
    assert (raised.value.width_px, raised.value.height_px) == (90000, 90000)
