#include <ddacontact/scene/record_notes.hpp>

#include <ddacontact/scene/text.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

namespace {

constexpr std::size_t fewest_entries = 5;

std::string vector_text(const Vec2& value) {
  return "(" + rounded(value.x()) + ", " + rounded(value.y()) + ")";
}

void add_note(const std::string& title, const std::vector<Vec3>& entries, std::vector<std::string>& notes) {
  if (entries.size() < fewest_entries) return;
  const Vec3* largest = &entries.front();
  for (const Vec3& entry : entries)
    if (entry.tail<2>().squaredNorm() > largest->tail<2>().squaredNorm()) largest = &entry;
  const auto [displacement, velocity] =
      history_function(TimeFunction::Kind::acceleration_history, entries).curve.back();
  const std::string note =
      title + ": " + std::to_string(entries.size()) + " entries from t = " + rounded(entries.front()[0]) +
      " to " + rounded(entries.back()[0]) + " s, the largest acceleration " +
      vector_text(largest->tail<2>()) + " m/s2 at t = " + rounded((*largest)[0]) +
      " s; its baseline is not corrected: it ends with the velocity " + vector_text(velocity) +
      " m/s and the displacement " + vector_text(displacement) + " m";
  if (std::ranges::count(notes, note) == 0) notes.push_back(note);
}

}  // namespace

std::vector<std::string> notes_on_records(const Scene& scene) {
  std::vector<std::string> notes;
  for (const Quake& quake : scene.quakes)
    add_note("record of a [[quake]]", quake.acceleration.history, notes);
  for (const Support& support : scene.supports)
    if (support.displacement.kind == TimeFunction::Kind::acceleration_history)
      add_note("record of a [[support]]", support.displacement.history, notes);
  return notes;
}

}  // namespace ddacontact::scene_format
