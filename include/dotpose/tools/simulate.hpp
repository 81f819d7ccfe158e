/// Simulated printer and camera: frames with exactly known poses.
///
/// A frame is rendered from the geometry of the printed page, in this order: paper with texture,
/// ink, light, blur, motion, integration over the area of each pixel, noise, clipping, rounding.
/// The centroid of a dot is accurate to 0.003 px (tested in tests/unit/simulate).
///
/// Usage: fill in a `Setup`, then render frame i:
///
///     const Shot shot = draw_shot(setup, i);  // change anything here: shot.pose.theta_rad = 0;
///     const GreyImage image = render(shot);
///
/// Each frame depends only on (setup, i), and is bit-identical on all machines, regardless of the
/// rendering order and the number of threads. All functions are pure and thread-safe. Functions
/// throw BadArgument for invalid values.
///
/// Coordinate frames: *pixel* (the centre of the first pixel is (0, 0), v down), *pattern* (x
/// right, y DOWN as the page is read, mm). Offsets named `offset_mm` are in the pattern frame,
/// relative to the pose point, which is the pattern point under the image centre. Offsets are small
/// numbers, so their rounding errors are negligible, although the plane is 2.1e8 mm wide.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/random.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// A 2D point or vector. Suffixes of variable names, such as _px or _mm, give the unit.
struct Vec2 {
    double x = 0;
    double y = 0;
};

/// Size and optics of the simulated camera. The defaults describe the device in the paper (section
/// III-A).
struct CameraModel {
    int width_px = 188;   ///< 1 to 16384
    int height_px = 120;  ///< 1 to 16384
    /// Size of the pixel at the image centre, measured on the paper, without tilt. Above 0.
    double mm_per_px = 0.046;
    /// Radial distortion k, in px^-2: p_u = m + r_d / (1 + k |r_d|^2), where m is the image centre
    /// (paper, equations 1 and 2). Negative for barrel distortion. |k| |r|^2 must be at most
    /// 0.9 in the corners of the image.
    double k = 0;
    /// Distance of the projection centre from the pose point. It matters only if the camera is
    /// tilted. Above 0.
    double working_distance_mm = 16;
    /// Motion of the scene in the undistorted image while a rolling shutter reads the rows. At most
    /// 75 % of the image size along each axis. The pose refers to the time at which the middle row
    /// is read. (0, 0) for a global shutter.
    Vec2 readout_px;
    /// Rotation of the scene about the image centre while a rolling shutter reads the rows, in
    /// addition to the motion. The direction is from the image x axis towards the image y axis.
    /// Velocity and turn rate are constant, as on a robot that drives in a circle. No part of the
    /// scene may move down faster than the rows are read, which limits the rotation to about 80
    /// degrees in a 4:3 image.
    double readout_turn_rad = 0;
};

/// Pose of the camera. The pattern point under the image centre is cell + fraction.
struct CameraPose {
    Cell cell;
    double fraction_x = 0;  ///< offset from `cell` along x, in grid units, usually in [0, 1)
    double fraction_y = 0;
    /// Angle of the image x axis at the image centre, in the pattern frame. Measured from +x
    /// towards +y, which is clockwise as seen on the paper.
    double theta_rad = 0;
    /// Tilt of the paper about the image x axis. If above 0, the paper recedes towards the bottom.
    double tilt_x_rad = 0;
    /// Tilt about the image y axis. If above 0, the paper comes closer towards the right.
    double tilt_y_rad = 0;
};

/// Return the position in spacings: the sum of cell and fraction.
double x_grid(const CameraPose& pose);
double y_grid(const CameraPose& pose);

/// Effects of the printer, paper, light and sensor on a frame. The defaults are those of the
/// `clean` preset, which has none of these effects. Fractions and reflectances are in [0, 1].
/// Sigmas, lengths and counts must not be negative.
struct Imperfections {
    double paper_level = 200;       ///< grey level of bare paper at the image centre, 0 to 255
    double ink_reflectance = 0.15;  ///< reflectance relative to paper
    double ink_variation = 0;  ///< standard deviation of a dot's reflectance, relative to paper
    /// Contrast of the palest ink relative to the darkest ink. Each of the four directions of
    /// displacement has its own ink. The reflectance of the darkest ink is `ink_reflectance`. The
    /// contrasts of the four inks are evenly spaced.
    double palest_ink = 1;
    /// Relative loss of light in the image corners. The loss is proportional to the square of the
    /// distance from the image centre.
    double vignetting = 0;
    /// Linear change in illumination across the image, relative to the illumination at the centre.
    /// 0 to 2.
    double fall = 0;
    /// Direction in which the light decreases, as an angle from +u towards +v.
    double fall_direction_rad = 0;
    double blur_sigma_px = 0;
    /// Motion of the scene in the image during the exposure. The pose refers to the middle of the
    /// exposure.
    Vec2 motion_px;
    double noise_sigma = 0;  ///< standard deviation of the noise, in grey levels
    /// Standard deviation of the fixed-pattern noise, in grey levels: an offset of each pixel that
    /// is the same in every frame.
    double fixed_pattern = 0;
    double salt_and_pepper = 0;  ///< fraction of the pixels that are set to black or white
    double jitter_mm = 0;        ///< standard deviation of a printed dot's position, per axis
    double missing = 0;          ///< fraction of the dots that are not printed
    int dirt_blobs = 0;          ///< number of dark specks in the frame
    int graphics = 0;            ///< number of thick strokes or words in the frame
    double texture = 0;          ///< standard deviation of the paper's reflectance
    static constexpr double kGrain_px = 3;  ///< grain size of the texture
    /// Tilt that `draw_shot` adds to the pose. `render` ignores it.
    double tilt_x_rad = 0;
    double tilt_y_rad = 0;
    /// Number of sub-pixels per pixel along each axis: 2, 4 or 8. If 0, the number is chosen so
    /// that the position error of every dot is at most 0.003 px. Larger numbers take longer.
    int sub_pixels = 0;
};

/// Named sets of imperfections, as used in the accuracy tables.
enum class Preset : std::uint8_t {
    clean,    ///< no imperfections
    nominal,  ///< a good printer and the paper's camera
    hard,     ///< a poor print, little light, dirt, tilt
    mouse,    ///< the sensor of an optical mouse
};
/// All values of Preset, for iteration.
inline constexpr std::array kPresets = {Preset::clean, Preset::nominal, Preset::hard,
                                        Preset::mouse};
/// Returns the identifier, such as "nominal".
const char* name(Preset preset);

/// Draws each imperfection uniformly from its range in the preset.
Imperfections draw_imperfections(Preset preset, Rng& rng);

/// A rectangle on a page, rotated by any angle.
struct PageArea {
    double x_grid = 0;  ///< centre, in grid units
    double y_grid = 0;
    double half_width = 0;  ///< in grid units
    double half_height = 0;
    /// Direction of the side along `half_width`, as an angle from +x towards +y.
    double angle_rad = 0;

    /// Returns the distance of a point from the area, in grid units. The distance is negative
    /// inside the area.
    double distance(double x, double y) const;
};

/// A printed page: a pattern, its printing errors, and its extent.
struct Page {
    Pattern pattern;
    /// Seed for the printing errors and the paper texture. The jitter and the ink of a dot, and
    /// whether it is missing, depend only on the seed, the section and the cell, so they are the
    /// same in every frame.
    std::uint64_t seed = 1;
    /// Printed intersections: `columns` x `rows`, starting at `origin`. The whole plane if
    /// `columns` is 0.
    Cell origin;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    /// Ratio of the printed to the nominal length, above 0. The pose and `displacement_mm` are in
    /// nominal units. Offsets and theta are measured on the paper.
    AxisScale print_scale;
    /// Areas with printed dots: a dot is printed if its intersection is in one of the areas. If
    /// empty, all dots are printed.
    std::vector<PageArea> areas;
    /// Area of the paper. If none, the paper extends indefinitely.
    std::optional<PageArea> paper;
    /// Reflectance of the table around the paper, relative to the paper.
    double table_reflectance = 0.2;
    /// Optional function that returns the offset in mm of a dot from its intended position, due to
    /// printing errors or bent paper. The argument is the intersection of the dot, in grid units.
    /// Called from several threads.
    std::function<Vec2(Vec2 place_grid)> shift_mm;
};

/// Returns the page of a printed sheet. Throws BadArgument if the sheet has no intersections.
Page page_of(const Sheet& sheet, std::uint64_t seed = 1);

/// Camera geometry: converts between pixels and offsets from the pose point. The two conversions
/// are inverses of each other.
class Projection {
  public:
    Projection(const CameraModel& camera, const CameraPose& pose);

    /// Returns the pixel at which the point with this offset appears. If the camera cannot see the
    /// point, returns (1e9, 1e9), which is far outside the image.
    Vec2 pixel_from_offset(Vec2 offset_mm) const;
    /// Returns the offset, in mm, of the point that appears at this pixel.
    Vec2 offset_from_pixel(Vec2 pixel) const;
    /// Computes `offset_from_pixel` for adjacent pixels of a row, starting at `first_pixel` and
    /// proceeding to the right.
    void offsets_from_row(Vec2 first_pixel, std::span<Vec2> offsets_mm) const;

  private:
    /// Returns the position, at `time`, of a scene point that is at `undistorted` when the middle
    /// row is read. Points are in px from the centre of the undistorted image. `time` is 0 when the
    /// middle row is read, and is in units of the readout time.
    Vec2 moved(Vec2 undistorted, double time) const;
    /// Returns the displacement of the pose point in the undistorted image between the time of the
    /// middle row and `time`. The pose point moves along an arc.
    Vec2 way_at(double time) const;

    Vec2 centre_px_;
    double height_px_;
    Vec2 readout_px_;
    double readout_turn_rad_;
    double k_;
    double focal_px_;
    double distance_mm_;
    // Axes of the pattern in the frame of the camera (x right, y down, z forward): camera_mm =
    // x_axis * offset.x + y_axis * offset.y + (0, 0, distance).
    std::array<double, 3> x_axis_;
    std::array<double, 3> y_axis_;
};

/// Renders the camera's image. `seed` determines noise, dirt and graphics.
GreyImage render(const Page& page, const CameraModel& camera, const CameraPose& pose,
                 const Imperfections& imperfections, std::uint64_t seed);

/// Variant of `render` for a page that contains the whole plane and whose seed is 1.
GreyImage render(const Pattern& pattern, const CameraModel& camera, const CameraPose& pose,
                 const Imperfections& imperfections, std::uint64_t seed);

/// A page given as an image, for example a PDF rendered at 1200 dpi. Grey levels between the pixels
/// are interpolated linearly.
struct PageImage {
    /// Grey level 255 is bare paper, and 0 is solid ink. Outside the image, the paper is bare and
    /// extends indefinitely.
    ImageView image;
    double mm_per_px = 25.4 / 1200;
    /// Point of the page under the centre of the rendered image, relative to the upper left corner
    /// of `image`: x right, y down.
    Vec2 centre_mm;
};

/// Renders the camera's view of a page that is given as an image. Ignores the position in `pose`,
/// because `PageImage::centre_mm` replaces it. Also ignores the imperfections of the printer
/// (jitter, missing dots), dirt and graphics.
GreyImage render(const PageImage& page, const CameraModel& camera, const CameraPose& pose,
                 const Imperfections& imperfections, std::uint64_t seed);

/// Parameters common to all frames of a run.
struct Setup {
    Preset preset = Preset::nominal;
    Pattern pattern;             ///< the section is used only if `random_section` is false
    bool random_section = true;  ///< true if each frame has a random section
    CameraModel camera;
    std::uint64_t seed = 1;
};

/// All inputs of one frame. The true section is `page.pattern.section`, and the true pose is
/// `pose`.
struct Shot {
    Page page;
    CameraModel camera;
    CameraPose pose;
    Imperfections imperfections;
    std::uint64_t seed = 0;
};

/// Draws the random parameters of frame `index` of a run: an angle, a position at which the whole
/// frame is inside the code plane, imperfections from the preset and, if `setup.random_section` is
/// set, a section. Throws BadArgument if the frame is larger than the code plane.
Shot draw_shot(const Setup& setup, std::uint64_t index);

/// A view that is only partly covered by the pattern.
struct PartialView {
    /// Number of separate rectangles with dots, anywhere in the image. Each rectangle contains at
    /// least `kMinIslandDots` dots. If 0, there is a single area with dots, along a border or in a
    /// corner of the image.
    int islands = 0;
    static constexpr int kMinIslandDots = 60;
    /// Minimum and maximum fraction of the image that the single area covers. The area has at least
    /// `min_dots` dots, even if it then covers more than `max_fraction`.
    double min_fraction = 0.15;
    double max_fraction = 0.45;
    int min_dots = 150;
    /// True if the single area is the corner or side of a sheet on a table.
    bool on_table = false;
};

/// Chooses the areas with dots and the edge of the paper at random, using the shot's seed. Areas
/// are aligned either with the pattern or with the image, with equal probability. Throws
/// BadArgument if 0 < `min_fraction` <= `max_fraction` <= 1 does not hold, if the number of islands
/// is outside [0, 16], or if there is no room for the islands.
void cover_partly(Shot& shot, const PartialView& view);

/// Renders a shot.
GreyImage render(const Shot& shot);

/// Kinds of frames without a unique valid position. A locator must reject these frames, with one
/// exception: in the two seam scenes, a fix with the position and section of either side is
/// correct.
enum class Scene : std::uint8_t {
    black,
    white,
    noise,           ///< no pattern: each pixel is dark with probability `density`
    text,            ///< a page of words
    plain_grid,      ///< dots on the intersections, not displaced
    random_symbols,  ///< a perfect grid with random symbols
    scattered_dots,  ///< dots at random positions, `density` per grid cell
    checkerboard,    ///< squares with a side of two grid spacings
    seam_vertical,   ///< two sections side by side, with the border through the image centre
    /// Two sections, one above the other, with the border through the image centre.
    seam_horizontal,
    mirrored,  ///< the pattern seen from behind
};
/// All values of Scene, for iteration.
inline constexpr std::array kScenes = {
    Scene::black,         Scene::white,           Scene::noise,          Scene::text,
    Scene::plain_grid,    Scene::random_symbols,  Scene::scattered_dots, Scene::checkerboard,
    Scene::seam_vertical, Scene::seam_horizontal, Scene::mirrored};
/// Returns the identifier, such as "seam_vertical".
const char* name(Scene scene);

/// Renders `scene` in place of the shot's page, with the shot's camera, pose and imperfections.
/// `density`, 0 to 1, is used only for `noise` and `scattered_dots`.
GreyImage render_scene(Scene scene, const Shot& shot, double density = 0.5);

}  // namespace dotpose

DOTPOSE_END_EXPORT
