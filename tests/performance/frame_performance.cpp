// How long frames of many blocks take: frame_performance [DIRECTORY], medians of five, with one thread and
// with two.
//
// A honeycomb or a grid of 1e5 blocks with all fields. Displacements and stresses are noise, which no
// compression can shorten much: a run's own numbers are no worse.

#include <ddacontact/output/frame_file.hpp>
#include <ddacontact/output/frame_reader.hpp>
#include <ddacontact/scene/builder.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numbers>
#include <random>

using namespace ddacontact;

namespace {

/// n x n regular polygons with 4 or 6 corners, not quite touching.
Scene tiling(int n, int corners) {
  Scene scene;
  scene.analysis.steps = 1;
  scene.analysis.time_step = 1e-3;
  scene.materials = {{"rock", 2500, 35e9, 0.3}};
  scene.joints = {{"joint", 30, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 1e12;
  scene.contact.tangential_stiffness = 4e11;
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  const double height = corners == 6 ? std::sqrt(3) / 2 : 1,
               radius = corners == 6 ? 1 / std::sqrt(3) : std::sqrt(0.5);
  for (int k = 0; k < n * n; ++k) {
    const int row = k / n, column = k % n;
    const Vec2 centre(column + (corners == 6 ? 0.5 * (row % 2) : 0), row * height);
    BlockDescription block;
    block.vertices.resize(2, corners);
    for (int v = 0; v < corners; ++v) {
      const double angle = (2 * v + 1) * std::numbers::pi / corners;
      block.vertices.col(v) = centre + 0.99 * radius * Vec2(std::cos(angle), std::sin(angle));
    }
    block.velocity = Vec2(noise(random), noise(random));
    block.angular_velocity = noise(random);
    block.stress = 1e5 * Vec3(noise(random), noise(random), noise(random));
    scene.blocks.push_back(block);
  }
  return scene;
}

void add_noise(double scale, Points& values) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise;
  for (double& value : values.reshaped()) value += scale * noise(random);
}

/// Medians of five.
struct Milliseconds {
  double wall = 0, processor = 0;
};

Milliseconds measure(const std::function<void()>& task) {
  std::array<double, 5> wall{}, processor{};
  for (std::size_t k = 0; k < wall.size(); ++k) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor_start = std::clock();
    task();
    wall[k] = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    processor[k] = 1e3 * static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  }
  std::ranges::sort(wall);
  std::ranges::sort(processor);
  return {wall[2], processor[2]};
}

void report(const char* shape, int corners, const std::filesystem::path& directory) {
  const BuiltScene built = build(tiling(317, corners));
  const std::filesystem::path path = directory / (std::string(shape) + ".vtu"),
                              contacts = directory / (std::string(shape) + "_contacts.vtu");
  Frame frame;
  const Milliseconds capture = measure([&] { frame = capture_frame(*built.stepper, built.labels, {}); });
  add_noise(1e-3, frame.displacement);
  add_noise(1e-3, frame.strain_displacement);
  const Milliseconds write = measure([&] { write_blocks(path, frame, {}); });
  const Milliseconds write_by_two = measure([&] { write_blocks(path, frame, {.n_threads = 2}); });
  write_contacts(contacts, frame);
  const Milliseconds read = measure([&] { read_frame({frame.step, frame.time, path, contacts}); });
  std::printf("%d %s, %.1f MB\n", frame.n_blocks(), shape,
              static_cast<double>(std::filesystem::file_size(path)) / 1e6);
  for (const auto& [task, time] :
       {std::pair("capture", capture), {"write", write}, {"write, 2 threads", write_by_two}, {"read", read}})
    std::printf("  %-16s %5.0f ms, %5.0f ms of the processor\n", task, time.wall, time.processor);
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path directory = argc > 1 ? argv[1] : std::filesystem::temp_directory_path();
  report("quadrilaterals", 4, directory);
  report("hexagons", 6, directory);
}
