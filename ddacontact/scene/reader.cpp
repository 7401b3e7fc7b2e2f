#include <ddacontact/scene/reader.hpp>

#include <ddacontact/scene/document_reader.hpp>
#include <ddacontact/scene/resolve.hpp>
#include <ddacontact/scene/settings.hpp>
#include <ddacontact/scene/toml_file.hpp>

#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <sstream>

namespace ddacontact {

namespace {

using scene_format::ProblemList;

std::optional<Scene> read(const std::string& text, const std::vector<std::string>& settings,
                          ProblemList& problems) {
  std::optional<toml::table> root = scene_format::parse_toml(text, problems.file(), problems);
  if (!root) return std::nullopt;
  scene_format::apply_settings(settings, *root, problems);
  const scene_format::Document document = scene_format::read_document(*root, problems);
  Scene scene = scene_format::resolve(document, problems);
  if (problems.has_errors()) return std::nullopt;
  return scene;
}

}  // namespace

SceneReading read_scene_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& settings) {
  SceneReading reading;
  ProblemList problems(name);
  try {
    reading.scene = read(text, settings, problems);
  } catch (const std::exception& error) {
    problems.error({}, std::string("the scene cannot be read: ") + error.what(),
                   "make it smaller or simpler");
  }
  reading.problems = std::move(problems).sorted();
  return reading;
}

SceneReading read_scene(const std::string& path, const std::vector<std::string>& settings) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  // An empty file sets failbit on `text`: nothing was inserted.
  const bool unreadable = !file.is_open() || file.bad() || (text.fail() && errno != 0);
  if (!unreadable) return read_scene_text(text.str(), path, settings);

  SceneReading reading;
  reading.unreadable = true;
  ProblemList problems(path);
  problems.error({}, "'" + path + "' cannot be read: " + std::strerror(errno != 0 ? errno : EIO),
                 "check the path and the permissions");
  reading.problems = std::move(problems).sorted();
  return reading;
}

}  // namespace ddacontact
