# Formula of the core for Homebrew. Before it is submitted, `url` and `sha256` must name a release.
class Dotpose < Formula
  desc "Locates a camera on a sheet printed with tiny dots, to microns"
  homepage "https://example.org/dotpose"
  url "https://example.org/dotpose.git", tag: "v0.2.0"
  license "MIT"

  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "pkgconf" => :build
  depends_on "fmt"
  depends_on "libpng"
  depends_on "nlohmann-json"
  depends_on "yaml-cpp"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DDOTPOSE_PARTS=CORE",
           "-DDOTPOSE_WITH_PRINT=ON", "-DDOTPOSE_WITH_FILES=ON", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    (testpath/"test.cpp").write <<~CPP
      #include <dotpose/dotpose.hpp>
      int main() {
          const std::uint8_t pixels[188 * 120] = {};
          dotpose::Locator locator;
          return locator.locate({pixels, 188, 120, 188}) ? 1 : 0;
      }
    CPP
    system ENV.cxx, "-std=c++20", "test.cpp", "-I#{include}", "-L#{lib}", "-ldotpose", "-o", "test"
    system "./test"
  end
end
