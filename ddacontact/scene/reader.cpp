#include <ddacontact/scene/reader.hpp>

#include <ddacontact/scene/complete_document.hpp>
#include <ddacontact/scene/document_reader.hpp>
#include <ddacontact/scene/file_text.hpp>
#include <ddacontact/scene/parameters.hpp>
#include <ddacontact/scene/resolve.hpp>
#include <ddacontact/scene/settings.hpp>
#include <ddacontact/scene/toml_file.hpp>

#include <exception>

namespace ddacontact {

namespace {

using scene_format::Document;
using scene_format::ProblemList;

void read(const std::string& text, const std::vector<std::string>& settings,
          const std::filesystem::path& directory, bool goes_on, ProblemList& problems,
          SceneReading& reading) {
  std::optional<toml::table> root = scene_format::parse_toml(text, problems.file(), problems);
  if (!root) return;
  scene_format::apply_settings(settings, *root, problems);
  scene_format::put_parameters(*root, problems);
  Document document = scene_format::read_document(*root, problems);
  document.goes_on = goes_on;
  reading.unreadable = !scene_format::complete_document(directory, document, problems);
  Scene scene = scene_format::resolve(document, problems);
  if (!problems.has_errors()) reading.scene = std::move(scene);
}

}  // namespace

SceneReading read_scene_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& settings, const std::filesystem::path& directory,
                             bool goes_on) {
  SceneReading reading;
  ProblemList problems(name);
  try {
    read(text, settings, directory, goes_on, problems, reading);
  } catch (const std::exception& error) {
    problems.error({}, std::string("the scene cannot be read: ") + error.what(),
                   "make it smaller or simpler");
  }
  reading.problems = std::move(problems).sorted();
  return reading;
}

SceneReading read_scene(const std::string& path, const std::vector<std::string>& settings, bool goes_on) {
  const scene_format::FileText file = scene_format::read_text(path);
  if (file.text)
    return read_scene_text(*file.text, path, settings, std::filesystem::path(path).parent_path(), goes_on);

  SceneReading reading;
  reading.unreadable = true;
  ProblemList problems(path);
  problems.error({}, "'" + path + "' cannot be read: " + file.reason, "check the path and the permissions");
  reading.problems = std::move(problems).sorted();
  return reading;
}

}  // namespace ddacontact
