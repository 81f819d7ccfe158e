#include "texts.hpp"

#include <fmt/core.h>

#include "dotpose/pose_packet.hpp"

namespace dotpose::fuzz {
namespace {

/// Returns a PDF document with these objects, which are numbered 1, 2, ... The first object is the
/// catalogue.
std::string pdf(const std::vector<std::string>& objects) {
    std::string text = "%PDF-1.5\n";
    std::string places = "0000000000 65535 f \n";
    for (std::size_t i = 0; i < objects.size(); ++i) {
        places += fmt::format("{:010} 00000 n \n", text.size());
        text += fmt::format("{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
    }
    return text + fmt::format(
                      "xref\n0 {0}\n{1}trailer << /Size {0} /Root 1 0 R >>\n"
                      "startxref\n{2}\n%%EOF\n",
                      objects.size() + 1, places, text.size());
}

std::string stream(const std::string& keys, const std::string& data) {
    return fmt::format("<< /Length {} {} >>\nstream\n{}\nendstream", data.size(), keys, data);
}

std::string document() {
    return pdf(
        {"<< /Type /Catalog /Pages 2 0 R >>",
         "<< /Type /Pages /Kids [3 0 R] /Count 1 /Rotate 90 /MediaBox [0 0 400 300] >>",
         "<< /Type /Page /Parent 2 0 R /Contents [4 0 R 4 0 R] /UserUnit 1.5 /Group << /CS "
         "/DeviceRGB >> /Annots [<< /AP << /N 5 0 R >> >>] /Resources << /XObject << /F 5 0 R /I "
         "6 0 R >> /Pattern << /P 7 0 R >> /ColorSpace << /C [/Separation /Black /DeviceGray 8 0 "
         "R] >> /Font << /T << /Subtype /Type3 /CharProcs << /a 4 0 R >> >> >> >> >>",
         stream("",
                "q 1 0 0 RG /C cs 1 scn 0 0 9 9 re B /F Do [(a) 3 <61>] TJ BI /W 1 /H 1 /BPC 8 "
                "/CS /G ID x\nEI Q q"),
         stream("/Type /XObject /Subtype /Form /BBox [0 0 9 9] /Filter /ASCIIHexDecode",
                "30206720660a>"),
         stream("/Subtype /Image /Width 1 /Height 1 /BitsPerComponent 8 /ColorSpace [/Indexed "
                "/DeviceRGB 1 <000000ffffff>] /Decode [0 1]",
                "x"),
         stream("/PaintType 1 /BBox [0 0 9 9] /Resources << /XObject << /F 5 0 R >> >>", "/F Do"),
         stream("/FunctionType 4 /Domain [0 1] /Range [0 1]", "{ }")});
}

constexpr const char* kSheets = R"({"format": "dotpose-sheets", "version": 1, "sheets": [{
"name": "table", "page": 2, "code": "microdots", "section_u": 5, "section_v": 62,
"origin_x": 1000, "origin_y": 410000000, "columns": 20, "rows": 10,
"spacing_mm": 0.6, "displacement_mm": 0.1, "dot_mm": 0.12,
"width_mm": 40, "height_mm": 30, "first_x_mm": 7.5, "first_y_mm": 8.25,
"print_scale_x": 1.01, "print_scale_y": 0.99, "world": {"x_m": -1.5, "y_m": 2, "yaw_rad": 3}}]})";

constexpr const char* kCamera = R"(format: dotpose-camera
version: 1
width_px: 188
height_px: 120
k_per_px2: 1e-7
centre_px: [93.5, 59.5]
mm_per_px: [0.046, 0.046]
skew: 0
perspective_per_px: [0, 1e-5]
focal_px: 300
tilt_rad: [0, 0.1]
reference_px: [90, 60]
theta_offset_rad: 0.1
tip_mm: [0.5, 5, 18]
tip_rest_mm: 0.1
exposure_us: 100
gain: 2
)";

constexpr const char* kRosCamera = R"(image_width: 188
image_height: 120
distortion_model: plumb_bob
camera_matrix: {rows: 3, cols: 3, data: [300, 0, 93, 0, 300, 59, 0, 0, 1]}
distortion_coefficients: {rows: 1, cols: 5, data: [0.01, 0, 0, 0, 0]}
)";

constexpr const char* kLog =
    "frame,t_s,file,status,dots_seen,p_wrong,state,events,verdict,plane,track_x_mm,track_y_mm,"
    "vx_mm_s,vy_mm_s\n"
    "0,0.0,\"a \"\"b\"\",c\",ok,174,1.46e-11,moving,fix,accepted,pattern,2539.9,3555.9,0.1,-0.2\n"
    "1,0.033,b,too_few_dots,3,,lost,lost,,,,,,\n"
    "2,0.066,c,ok,177,1e-11,stationary,kidnapped,gated,world,2540.0,3556.0,0,0\n";

constexpr const char* kStates =
    "\t{\"headerId\":7,\"timestamp\":\"2026-11-24T16:20:00.5Z\",\"state\":\"moving\","
    "\"agvPosition\":{\"mapId\":\"hall\",\"x\":1.5,\"y\":-2,\"theta\":0.1,"
    "\"deviationRange\":0.001},\"velocity\":{\"vx\":0.1,\"vy\":0,\"omega\":0}}\n"
    "uagv/v2/dotpose/bob/visualization\t{\"headerId\":8,\"timestamp\":\"2026-11-24T16:20:01Z\","
    "\"state\":\"lost\",\"reason\":\"no_grid\",\"sheet\":\"left\",\"camera\":{\"rate\":30,"
    "\"frames\":90,\"refused\":{\"no_grid\":3,\"?\":1}}}\n"
    "uagv/v2/dotpose/carl/connection\t\n"
    "uagv/v2/dotpose/bob/connection\t{\"headerId\":1,\"timestamp\":\"2026-11-24T16:20:01Z\","
    "\"connectionState\":\"OFFLINE\"}\n";

constexpr const char* kOptions =
    "--origin\n1000,2000\n--section\n1,2\n--spacing\n0.5\n--dot=0.1\n--size\n188x120\n--code\n"
    "microdots\n--number\n1e5\n--paper\n100x62.5\n--decoder\nwindow\n--k\n1e-7\n";

std::string packets() {
    std::string bytes = "noise";
    for (std::uint16_t sequence = 0; sequence < 3; ++sequence) {
        PosePacket packet;
        packet.sequence = sequence;
        packet.status = sequence == 1 ? Status::too_few_dots : Status::ok;
        if (packet.status == Status::ok) packet.cell = {123'456'789, 42};
        const PacketBytes packed = encode(packet);
        bytes.append(packed.begin(), packed.end());
    }
    return bytes;
}

}  // namespace

std::vector<TextSeed> text_seeds() {
    const std::string token = "0123456789abcdef0123456789abcdef";
    return {{"overlay/document.pdf", document()},
            {"overlay/blank.pdf",
             pdf({"<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
                  "<< /Type /Page /MediaBox [0 0 200 200] >>"})},
            {"sheet_file/sheets.json", kSheets},
            {"camera_file/camera.yaml", kCamera},
            {"camera_file/ros.yaml", kRosCamera},
            {"run_log/run.csv", kLog},
            {"list/names", "a.pgm\n\nb c.png\r\nlast"},
            {"fleet/states", kStates},
            {"command_line/command", kOptions},
            {"packet/packets", packets()},
            {"web_request/record", R"({"do": "record", "on": true})"},
            {"web_request/subscribe", R"({"do": "subscribe", "topic": "state", "n": -1.5e3})"},
            {"web_request/loopback", "localhost:8080\nhttp://localhost:8080\n\n\n"},
            {"web_request/cookie", "192.168.1.5:8080\n\na=b; dotpose-8080=" + token + "\n\n"},
            {"web_request/bearer", "[fe80::1]:8080\n\n\nBearer " + token + "\n"},
            {"web_request/url", "robot.local\n\n\n\n" + token}};
}

}  // namespace dotpose::fuzz
