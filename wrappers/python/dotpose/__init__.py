"""Computes the pose of a camera over a sheet printed with tiny dots, to microns.

A first program::

    import dotpose

    fix = dotpose.Locator().locate(image)  # a numpy array of uint8, height x width
    if fix:
        print(fix.x_mm, fix.y_mm, fix.theta_rad)
    else:
        print(fix.message)

Most programs need only Locator and Fix. Tracker follows a robot from frame to frame, and
Follower follows a robot over the sheets of a sheet file. print_sheet, overlay, check_print and
calibrate are equivalent to the commands of the tool. simulate renders frames with known poses.

Names have units as suffixes: _mm, _rad, _px, _us. In the pattern frame, x points to the right
and y DOWN on the page as it is read. Angles are clockwise as seen on the paper. The centre of
the first pixel is (0, 0).
"""

from dotpose._dotpose import (
    BadArgument,
    Camera,
    Error,
    Fix,
    ImageTooLarge,
    Locator,
    MeasuredMotion,
    Options,
    PaperScale,
    PenTip,
    Picture,
    Prediction,
    Shot,
    SimulatedFrame,
    Tilt,
    Track,
    Tracker,
    __version__,
    draw_shots,
    simulate,
)

try:
    from dotpose._tools import (
        DriveCalibration,
        Finding,
        Follower,
        LensCalibration,
        Located,
        MappedPage,
        OverlayReport,
        PivotCalibration,
        PrintCheck,
        PrintField,
        PrintMap,
        PrintMapResult,
        PrintScale,
        Protocol,
        ProtocolResult,
        Sheet,
        SheetEntry,
        SheetFile,
        SheetPlace,
        SpacePose,
        SpaceTrack,
        SpaceTracker,
        SpinCalibration,
        Station,
        Stitching,
        TipPose,
        WorldPlace,
        WorldPose,
        WorldSpacePose,
        calibrate,
        calibrate_drive,
        calibrate_pivot,
        calibrate_spin,
        check_print,
        make_print_map,
        make_sheet,
        make_sheets,
        overlay,
        print_sheet,
        print_sheets,
        read_image,
        read_sheets,
        run_protocol,
        stitch_sheets,
        write_image,
    )
except ModuleNotFoundError as error:
    if error.name != "dotpose._tools":
        raise

    # Wheels can only locate, track and simulate, because the tools require system libraries.
    def __getattr__(name):
        tools = """
            DriveCalibration Finding Follower LensCalibration Located
            MappedPage OverlayReport PivotCalibration PrintCheck PrintField PrintMap
            PrintMapResult PrintScale Protocol ProtocolResult Sheet SheetEntry SheetFile SheetPlace
            SpacePose SpaceTrack SpaceTracker SpinCalibration Station Stitching TipPose WorldPlace
            WorldPose WorldSpacePose
            calibrate calibrate_drive calibrate_pivot calibrate_spin check_print
            make_print_map make_sheet make_sheets overlay print_sheet print_sheets read_image
            read_sheets run_protocol stitch_sheets write_image
        """.split()
        if name in tools:
            raise ImportError(
                f"dotpose.{name} needs the tools of dotpose, which this installation does not have; "
                "install the Debian package python3-dotpose or build from source: "
                "wrappers/python/README.md"
            )
        raise AttributeError(f"module 'dotpose' has no attribute '{name}'")

__all__ = [name for name in dir() if not name.startswith("_")] + ["__version__"]
