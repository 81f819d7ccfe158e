"""Types of the package dotpose. The docstrings are in the compiled module."""

import os
from collections.abc import Iterable, Sequence
from types import TracebackType
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray

__version__: str

Code = Literal["anoto", "libdots", "microdots"]
CodeOrAuto = Literal["auto", "anoto", "libdots", "microdots"]
Status = Literal[
    "ok",
    "bad_argument",
    "image_too_small",
    "image_too_large",
    "no_contrast",
    "too_few_dots",
    "no_grid",
    "no_displacement",
    "grid_too_small",
    "not_run",
    "mirrored",
    "bad_window",
    "not_in_code",
    "ambiguous",
    "not_certain",
    "not_tracked",
    "ambiguous_code",
    "other",
]
Preset = Literal["clean", "nominal", "hard"]
Dots = Literal["auto", "glyphs", "strokes"]
Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Path = Union[str, os.PathLike[str]]
Pixel = tuple[float, float]

class Error(RuntimeError): ...
class BadArgument(Error, ValueError): ...

class ImageTooLarge(Error):
    width_px: int
    height_px: int

class Picture:
    @property
    def svg(self) -> str: ...
    def save(self, path: Path) -> None: ...
    def _repr_svg_(self) -> str: ...

class Options:
    def __init__(
        self,
        *,
        effort: Literal["device", "once", "twice"] = ...,
        decoder: Literal["window", "all"] = ...,
        min_contrast: int = ...,
        min_dots: int = ...,
        max_p_wrong: float = ...,
        max_bit_errors: float = ...,
        bits_per_error: int = ...,
        lens_k_per_px2: float = ...,
        lens_centre_offset_px: Pixel = ...,
    ) -> None: ...
    effort: Literal["device", "once", "twice"]
    decoder: Literal["window", "all"]
    min_contrast: int
    min_dots: int
    max_p_wrong: float
    max_bit_errors: float
    bits_per_error: int
    lens_k_per_px2: float
    lens_centre_offset_px: Pixel

class Fix:
    @property
    def ok(self) -> bool: ...
    def __bool__(self) -> bool: ...
    @property
    def status(self) -> Status: ...
    @property
    def message(self) -> str: ...
    @property
    def x_mm(self) -> float: ...
    @property
    def y_mm(self) -> float: ...
    @property
    def theta_rad(self) -> float: ...
    @property
    def covariance(self) -> Floats: ...
    @property
    def p_wrong(self) -> float: ...
    @property
    def section(self) -> Optional[tuple[int, int]]: ...
    @property
    def cell(self) -> Optional[tuple[int, int]]: ...
    @property
    def x_grid(self) -> float: ...
    @property
    def y_grid(self) -> float: ...
    @property
    def code(self) -> Code: ...
    @property
    def other(self) -> Optional[tuple[Code, tuple[int, int], tuple[int, int]]]: ...
    @property
    def spacing_mm(self) -> float: ...
    @property
    def spacing_px(self) -> float: ...
    # Evidence.
    @property
    def dots_seen(self) -> int: ...
    @property
    def dots_used(self) -> int: ...
    @property
    def attempt(self) -> Literal["tracked", "first", "second", "device"]: ...
    @property
    def surface(self) -> Literal["even", "divided", "uneven"]: ...
    @property
    def bit_errors(self) -> int: ...
    @property
    def residual_px(self) -> float: ...
    @property
    def prior(self) -> Literal["plane", "sheets", "only_sheets"]: ...
    @property
    def frames(self) -> int: ...
    @property
    def readout_turn_rad(self) -> float: ...
    @property
    def _bits(self) -> list[Any]: ...
    @property
    def dots(self) -> Floats: ...
    def draw(self, path: Optional[Path] = None, title: str = "") -> Picture: ...

class Prediction:
    @staticmethod
    def like(fix: Fix) -> Prediction: ...
    def moved(self, x_mm: float, y_mm: float, turn_rad: float = 0.0) -> Prediction: ...
    sigma_mm: float
    sigma_theta_rad: float

class MeasuredMotion:
    def __init__(
        self,
        *,
        right_mm: float = 0.0,
        down_mm: float = 0.0,
        turn_rad: float = 0.0,
        sigma_mm: float,
        sigma_rad: float,
    ) -> None: ...
    right_mm: float
    down_mm: float
    turn_rad: float
    sigma_mm: float
    sigma_rad: float

class PaperScale:
    mm_per_px_x: float
    mm_per_px_y: float
    skew: float
    perspective_u: float
    perspective_v: float

class Tilt:
    x_rad: float
    y_rad: float

class PenTip:
    def __init__(self, x_mm: float, y_mm: float, z_mm: float, rest_mm: float = 0.0) -> None: ...
    x_mm: float
    y_mm: float
    z_mm: float
    rest_mm: float

class Camera:
    def __init__(
        self,
        width_px: int,
        height_px: int,
        k_per_px2: float = 0.0,
        centre_px: Optional[Pixel] = None,
    ) -> None: ...
    @staticmethod
    def read(path: Path) -> Camera: ...
    def write(self, path: Path) -> None: ...
    width_px: int
    height_px: int
    k_per_px2: float
    centre_px: Pixel
    paper: Optional[PaperScale]
    focal_px: Optional[float]
    tilt: Optional[Tilt]
    reference_px: Optional[Pixel]
    theta_offset_rad: float
    tip: Optional[PenTip]
    flip: bool
    flat_field: list[list[float]]
    readout_ms: Optional[float]
    exposure_us: Optional[float]
    gain: Optional[float]
    sigma: dict[str, float]
    def undistorted(self, points: Floats) -> Floats: ...
    def distorted(self, points: Floats) -> Floats: ...

class Locator:
    def __init__(
        self,
        code: CodeOrAuto = "auto",
        spacing_mm: float = 0.508,
        *,
        camera: Optional[Camera] = None,
        reference_px: Optional[Pixel] = None,
        options: Options = ...,
        keep_stages: bool = False,
    ) -> None: ...
    def locate(
        self,
        image: Image,
        prediction: Optional[Prediction] = None,
        *,
        motion: Optional[MeasuredMotion] = None,
    ) -> Fix: ...
    def _cpp_us(self, image: Image, repeats: int) -> float: ...
    @property
    def code(self) -> Code: ...

class Track:
    @property
    def is_lost(self) -> bool: ...
    @property
    def is_stationary(self) -> bool: ...
    @property
    def verdict(self) -> Literal["none", "accepted", "with_prior", "gated", "too_weak"]: ...
    @property
    def p_wrong(self) -> float: ...
    @property
    def events(self) -> set[str]: ...
    @property
    def time_us(self) -> int: ...
    @property
    def x_mm(self) -> float: ...
    @property
    def y_mm(self) -> float: ...
    @property
    def theta_rad(self) -> float: ...
    @property
    def vx_mm_s(self) -> float: ...
    @property
    def vy_mm_s(self) -> float: ...
    @property
    def turn_rad_s(self) -> float: ...
    @property
    def covariance(self) -> Floats: ...

class Tracker:
    def __init__(
        self,
        *,
        acceleration_mm_s2: float = 600,
        angular_acceleration_rad_s2: float = 6,
        max_acceleration_mm_s2: float = 10_000,
        max_angular_acceleration_rad_s2: float = 200,
        max_speed_mm_s: float = 1000,
        max_turn_rad_s: float = 20,
        gate_sigmas: float = 5,
        confirmations: int = 3,
        lost_after_us: int = 70_000,
        max_sigma_mm: float = 5,
        still_mm: float = 0.1,
        still_rad: float = 0.02,
        stationary_after_us: int = 500_000,
        min_sigma_mm: float = 0.0002,
        min_sigma_rad: float = 0.00002,
        max_p_wrong_log2: int = -30,
        max_weak_p_wrong_log2: int = -10,
        spacing_mm: float = 0.508,
    ) -> None: ...
    def update(
        self, time_us: int, fix: Optional[Fix] = None, motion: Optional[MeasuredMotion] = None
    ) -> Track: ...
    def predict(self, time_us: int) -> Optional[Prediction]: ...
    @property
    def track(self) -> Track: ...

class Sheet:
    @property
    def code(self) -> Code: ...
    @property
    def section(self) -> tuple[int, int]: ...
    @property
    def spacing_mm(self) -> float: ...
    @property
    def displacement_mm(self) -> float: ...
    @property
    def dot_mm(self) -> float: ...
    @property
    def origin(self) -> tuple[int, int]: ...
    @property
    def columns(self) -> int: ...
    @property
    def rows(self) -> int: ...
    @property
    def width_mm(self) -> float: ...
    @property
    def height_mm(self) -> float: ...
    @property
    def origin_x_mm(self) -> float: ...
    @property
    def origin_y_mm(self) -> float: ...

class WorldPose:
    def __init__(self, x_m: float, y_m: float, yaw_rad: float = 0.0) -> None: ...
    x_m: float
    y_m: float
    yaw_rad: float

class SheetEntry:
    def __init__(self, name: str, sheet: Sheet) -> None: ...
    name: str
    page: int
    sheet: Sheet
    print_scale_x: float
    print_scale_y: float
    world: Optional[WorldPose]
    @property
    def is_reserved(self) -> bool: ...

class SheetFile:
    def __init__(self, path: Path, wait_s: float = 60.0) -> None: ...
    def __enter__(self) -> SheetFile: ...
    def __exit__(
        self,
        kind: Optional[type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None: ...
    @property
    def sheets(self) -> list[SheetEntry]: ...
    def allocate(self, name: str, sheet: Sheet, count: int = 1) -> list[SheetEntry]: ...
    def add(self, entry: SheetEntry) -> None: ...
    def replace(self, entry: SheetEntry) -> None: ...
    def rename(self, name: str, new_name: str) -> None: ...
    def remove(self, name: str) -> None: ...
    def save(self) -> None: ...

class WorldPlace:
    @property
    def x_m(self) -> float: ...
    @property
    def y_m(self) -> float: ...
    @property
    def yaw_rad(self) -> float: ...
    @property
    def covariance(self) -> Floats: ...

class SheetPlace:
    @property
    def entry(self) -> SheetEntry: ...
    @property
    def name(self) -> str: ...
    @property
    def x_mm(self) -> float: ...
    @property
    def y_mm(self) -> float: ...
    @property
    def theta_rad(self) -> float: ...
    @property
    def covariance(self) -> Floats: ...
    @property
    def world(self) -> Optional[WorldPlace]: ...

class WorldSpacePose:
    @property
    def position_m(self) -> tuple[float, float, float]: ...
    @property
    def quaternion(self) -> tuple[float, float, float, float]: ...
    @property
    def covariance(self) -> Floats: ...

class SpacePose:
    @property
    def position_mm(self) -> tuple[float, float, float]: ...
    @property
    def quaternion(self) -> tuple[float, float, float, float]: ...
    @property
    def tilt_rad(self) -> float: ...
    @property
    def azimuth_rad(self) -> float: ...
    @property
    def turn_rad(self) -> float: ...
    @property
    def covariance(self) -> Floats: ...
    @property
    def dots(self) -> int: ...
    @property
    def residual_px(self) -> float: ...
    @property
    def is_ambiguous(self) -> bool: ...
    @property
    def second(
        self,
    ) -> Optional[tuple[tuple[float, float, float], tuple[float, float, float, float], float]]: ...
    def on_sheet(self, entry: SheetEntry) -> tuple[float, float, float]: ...
    def in_world(self, entry: SheetEntry) -> Optional[WorldSpacePose]: ...

class TipPose:
    @property
    def x_mm(self) -> float: ...
    @property
    def y_mm(self) -> float: ...
    @property
    def height_mm(self) -> float: ...
    @property
    def covariance(self) -> Floats: ...
    def on_sheet(self, entry: SheetEntry) -> TipPose: ...

class SpaceTrack:
    @property
    def is_lost(self) -> bool: ...
    @property
    def is_new(self) -> bool: ...
    @property
    def verdict(self) -> Literal["none", "accepted", "second_accepted", "rejected"]: ...
    @property
    def time_us(self) -> int: ...
    @property
    def position_mm(self) -> tuple[float, float, float]: ...
    @property
    def quaternion(self) -> tuple[float, float, float, float]: ...
    @property
    def covariance(self) -> Floats: ...
    @property
    def velocity_mm_s(self) -> list[float]: ...
    @property
    def turn_rad_s(self) -> list[float]: ...
    @property
    def velocity_covariance(self) -> Floats: ...

class SpaceTracker:
    def __init__(
        self,
        *,
        acceleration_mm_s2: float = 2000,
        angular_acceleration_rad_s2: float = 20,
        hold_s: float = 0.5,
        speed_mm_s: float = 500,
        turn_rad_s: float = 5,
        max_innovation: float = 45,
        confirmations: int = 3,
        lost_after_us: int = 200_000,
    ) -> None: ...
    def update(
        self, time_us: int, pose: Optional[SpacePose] = None, plane: int = 0
    ) -> SpaceTrack: ...
    def predict(self, time_us: int) -> Optional[SpaceTrack]: ...
    @property
    def track(self) -> SpaceTrack: ...

class Located:
    @property
    def fix(self) -> Fix: ...
    @property
    def place(self) -> Optional[SheetPlace]: ...
    @property
    def space(self) -> Optional[SpacePose]: ...
    @property
    def tip(self) -> Optional[TipPose]: ...
    @property
    def is_pen_down(self) -> bool: ...
    @property
    def map_use(self) -> str: ...
    @property
    def track(self) -> Optional[Track]: ...
    @property
    def space_track(self) -> Optional[SpaceTrack]: ...
    @property
    def reduced_by(self) -> int: ...
    def __bool__(self) -> bool: ...

class PrintMap:
    @staticmethod
    def read(path: Path) -> PrintMap: ...
    def write(self, path: Path) -> None: ...
    @property
    def pages(self) -> list[str]: ...

class MappedPage:
    @property
    def name(self) -> str: ...
    @property
    def frames(self) -> int: ...
    @property
    def dots(self) -> int: ...
    @property
    def seen(self) -> int: ...
    @property
    def noise_mm(self) -> float: ...
    @property
    def jitter_mm(self) -> float: ...
    @property
    def error_mm(self) -> float: ...
    @property
    def slow_mm(self) -> float: ...
    @property
    def is_rigid(self) -> bool: ...

class PrintMapResult:
    @property
    def map(self) -> PrintMap: ...
    @property
    def pages(self) -> list[MappedPage]: ...
    @property
    def frames(self) -> int: ...

class Follower:
    def __init__(
        self,
        sheets: Sequence[SheetEntry] = ...,
        code: CodeOrAuto = "auto",
        spacing_mm: float = 0.508,
        *,
        camera: Optional[Camera] = None,
        reference_px: Optional[Pixel] = None,
        options: Options = ...,
        only_sheets: bool = False,
        keep_stages: bool = False,
        space: bool = False,
        print_map: Optional[PrintMap] = None,
        **track: float,
    ) -> None: ...
    def locate(self, image: Image) -> Located: ...
    def follow(self, image: Image, time_us: int) -> Located: ...
    @property
    def is_in_world(self) -> bool: ...
    @property
    def sheets(self) -> list[SheetEntry]: ...

class OverlayReport:
    @property
    def pages(self) -> list[tuple[int, Sheet]]: ...
    @property
    def warnings(self) -> list[str]: ...

class PrintScale:
    @property
    def scale_x(self) -> float: ...
    @property
    def scale_y(self) -> float: ...
    @property
    def rotation_rad(self) -> float: ...
    @property
    def skew_rad(self) -> float: ...

class Finding:
    @property
    def kind(self) -> str: ...
    @property
    def is_fault(self) -> bool: ...
    @property
    def field(self) -> Optional[int]: ...
    @property
    def text(self) -> str: ...

class PrintField:
    @property
    def code(self) -> Code: ...
    @property
    def section(self) -> tuple[int, int]: ...
    @property
    def origin(self) -> tuple[int, int]: ...
    @property
    def columns(self) -> int: ...
    @property
    def rows(self) -> int: ...
    @property
    def is_patch(self) -> bool: ...
    @property
    def sheet(self) -> Optional[int]: ...
    @property
    def scale(self) -> Optional[PrintScale]: ...
    @property
    def spacing_px(self) -> float: ...
    @property
    def residual_mm(self) -> float: ...
    @property
    def scatter_mm(self) -> float: ...
    @property
    def largest_distortion_mm(self) -> float: ...
    @property
    def cells(self) -> int: ...
    @property
    def missing(self) -> int: ...
    @property
    def merged(self) -> int: ...
    @property
    def covered(self) -> int: ...
    @property
    def dots(self) -> int: ...
    @property
    def bits_wrong(self) -> int: ...
    @property
    def dot_mm(self) -> float: ...
    @property
    def contrast(self) -> float: ...
    @property
    def gain(self) -> float: ...

class PrintCheck:
    @property
    def fields(self) -> list[PrintField]: ...
    @property
    def findings(self) -> list[Finding]: ...
    @property
    def is_good(self) -> bool: ...
    @property
    def code(self) -> Code: ...
    @property
    def is_test_page(self) -> bool: ...
    @property
    def best(self) -> Optional[int]: ...
    def draw(self, path: Path) -> None: ...

class LensCalibration:
    @property
    def camera(self) -> Camera: ...
    @property
    def verdict(self) -> str: ...
    @property
    def advice(self) -> str: ...
    @property
    def code(self) -> Code: ...
    @property
    def is_mounted(self) -> bool: ...
    @property
    def frames(self) -> int: ...
    @property
    def located(self) -> int: ...
    @property
    def dots(self) -> int: ...
    @property
    def outliers(self) -> int: ...
    @property
    def residual_before_px(self) -> float: ...
    @property
    def residual_px(self) -> float: ...
    @property
    def px_per_spacing(self) -> float: ...
    @property
    def coverage(self) -> float: ...
    def draw(self, path: Path) -> None: ...

class PivotCalibration:
    @property
    def camera(self) -> Camera: ...
    @property
    def located(self) -> int: ...
    @property
    def used(self) -> int: ...
    @property
    def residual_mm(self) -> float: ...

class SpinCalibration:
    @property
    def camera(self) -> Camera: ...
    @property
    def verdict(self) -> str: ...
    @property
    def offset_mm(self) -> tuple[float, float]: ...
    @property
    def located(self) -> int: ...
    @property
    def sigma_mm(self) -> float: ...
    @property
    def residual_mm(self) -> float: ...
    @property
    def turn_rad(self) -> float: ...
    def draw(self, path: Path) -> None: ...

class DriveCalibration:
    @property
    def camera(self) -> Camera: ...
    @property
    def located(self) -> int: ...
    @property
    def sigma_rad(self) -> float: ...
    @property
    def residual_mm(self) -> float: ...
    @property
    def length_mm(self) -> float: ...

class Stitching:
    @property
    def sheets(self) -> list[SheetEntry]: ...
    @property
    def unconnected(self) -> list[str]: ...
    @property
    def frames(self) -> int: ...
    @property
    def used(self) -> int: ...

class Shot:
    x_mm: float
    y_mm: float
    theta_rad: float
    tilt_x_rad: float
    tilt_y_rad: float
    paper_level: float
    ink_reflectance: float
    ink_variation: float
    palest_ink: float
    vignetting: float
    fall: float
    blur_sigma_px: float
    noise_sigma: float
    fixed_pattern: float
    salt_and_pepper: float
    jitter_mm: float
    missing: float
    texture: float
    seed: int
    @property
    def section(self) -> tuple[int, int]: ...
    @property
    def code(self) -> Code: ...
    def move(self, x_grid: float, y_grid: float) -> None: ...
    def render(self) -> Image: ...
    def __copy__(self) -> Shot: ...

class SimulatedFrame:
    @property
    def image(self) -> Image: ...
    @property
    def shot(self) -> Shot: ...

class Station:
    @property
    def place_mm(self) -> tuple[float, float]: ...
    @property
    def theta_deg(self) -> float: ...
    @property
    def x_mm(self) -> tuple[float, float]: ...
    @property
    def y_mm(self) -> tuple[float, float]: ...
    @property
    def theta_error_deg(self) -> tuple[float, float]: ...
    @property
    def samples(self) -> int: ...
    @property
    def located(self) -> int: ...
    @property
    def wrong(self) -> int: ...

class ProtocolResult:
    @property
    def positions(self) -> list[Station]: ...
    @property
    def angles(self) -> list[Station]: ...

class Protocol:
    @property
    def perfect(self) -> ProtocolResult: ...
    @property
    def printed(self) -> ProtocolResult: ...

def read_image(path: Path) -> Image: ...
def write_image(path: Path, image: Image) -> None: ...
def read_sheets(path: Path) -> list[SheetEntry]: ...
def make_sheet(
    paper: str = "A4",
    *,
    landscape: bool = False,
    margin_mm: float = 5.0,
    origin: tuple[int, int] = (0, 0),
    section: tuple[int, int] = (0, 0),
    code: Code = "anoto",
    spacing_mm: float = 0.508,
    dot_mm: Optional[float] = None,
    displacement_mm: Optional[float] = None,
) -> Sheet: ...
def make_sheets(
    pages: int,
    paper: str = "A4",
    *,
    landscape: bool = False,
    margin_mm: float = 5.0,
    origin: tuple[int, int] = (0, 0),
    section: tuple[int, int] = (0, 0),
    code: Code = "anoto",
    spacing_mm: float = 0.508,
    dot_mm: Optional[float] = None,
    displacement_mm: Optional[float] = None,
) -> list[Sheet]: ...
def print_sheet(
    path: Path,
    sheet: Optional[Sheet] = None,
    *,
    dpi: float = 600.0,
    dots: Dots = "auto",
    labels: bool = True,
    title: Optional[str] = None,
    sheet_file: Optional[Path] = None,
    name: Optional[str] = None,
) -> Sheet: ...
def print_sheets(
    path: Path,
    sheets: Sequence[Sheet],
    *,
    dpi: float = 600.0,
    dots: Dots = "auto",
    labels: bool = True,
    title: Optional[str] = None,
    sheet_file: Optional[Path] = None,
    name: Optional[str] = None,
) -> list[Sheet]: ...
def overlay(
    document: Path,
    path: Path,
    *,
    pages: str = "",
    origin: tuple[int, int] = (0, 0),
    section: tuple[int, int] = (0, 0),
    code: Code = "anoto",
    spacing_mm: float = 0.508,
    dot_mm: Optional[float] = None,
    displacement_mm: Optional[float] = None,
    margin_mm: float = 5.0,
    dpi: float = 600.0,
    dots: Dots = "auto",
    under: bool = False,
    cmy_black: bool = False,
    lighten: float = 0.0,
    password: str = "",
    sheet_file: Optional[Path] = None,
    name: Optional[str] = None,
) -> OverlayReport: ...
def check_print(
    scan: Union[Image, Path],
    *,
    code: CodeOrAuto = "auto",
    spacing_mm: float = 0.508,
    dot_mm: Optional[float] = None,
    displacement_mm: Optional[float] = None,
    sheets: Optional[Sequence[SheetEntry]] = None,
    is_photo: bool = False,
    dpi: Optional[float] = None,
    ink_reflectance: float = 0.15,
) -> PrintCheck: ...
def calibrate(
    images: Iterable[Union[Image, Path]],
    *,
    code: CodeOrAuto = "auto",
    spacing_mm: float = 0.508,
) -> LensCalibration: ...
def calibrate_pivot(
    images: Iterable[Union[Image, Path]],
    camera: Camera,
    *,
    code: CodeOrAuto = "auto",
    spacing_mm: float = 0.508,
) -> PivotCalibration: ...
def calibrate_spin(
    images: Iterable[Union[Image, Path]],
    camera: Optional[Camera] = None,
    *,
    code: CodeOrAuto = "auto",
    spacing_mm: float = 0.508,
) -> SpinCalibration: ...
def calibrate_drive(
    images: Iterable[Union[Image, Path]],
    camera: Optional[Camera] = None,
    *,
    code: CodeOrAuto = "auto",
    spacing_mm: float = 0.508,
) -> DriveCalibration: ...
def make_print_map(
    images: Iterable[Union[Image, Path]],
    sheets: Sequence[SheetEntry],
    camera: Optional[Camera] = None,
    earlier: Optional[PrintMap] = None,
) -> PrintMapResult: ...
def stitch_sheets(
    images: Iterable[Union[Image, Path]],
    sheets: Sequence[SheetEntry],
    camera: Optional[Camera] = None,
) -> Stitching: ...
def draw_shots(
    frames: int,
    preset: Preset = "nominal",
    *,
    seed: int = 1,
    code: Code = "anoto",
    spacing_mm: float = 0.508,
    section: Optional[tuple[int, int]] = None,
    width_px: int = 188,
    height_px: int = 120,
    mm_per_px: float = 0.046,
    k_per_px2: float = 0.0,
    first: int = 0,
) -> list[Shot]: ...
def simulate(
    frames: int,
    preset: Preset = "nominal",
    *,
    seed: int = 1,
    code: Code = "anoto",
    spacing_mm: float = 0.508,
    section: Optional[tuple[int, int]] = None,
    width_px: int = 188,
    height_px: int = 120,
    mm_per_px: float = 0.046,
    k_per_px2: float = 0.0,
    first: int = 0,
) -> list[SimulatedFrame]: ...
def run_protocol(samples: int = 20, *, seed: int = 1, threads: int = 0) -> Protocol: ...
