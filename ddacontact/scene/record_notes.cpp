#include <ddacontact/scene/record_notes.hpp>

#include <ddacontact/scene/text.hpp>

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
  notes.push_back(title + ": " + std::to_string(entries.size()) +
                  " entries from t = " + rounded(entries.front()[0]) + " to " + rounded(entries.back()[0]) +
                  " s, the largest acceleration " + vector_text(largest->tail<2>()) +
                  " m/s2 at t = " + rounded((*largest)[0]) +
                  " s; taken as it is, without a correction of its baseline, it ends "
                  "with the velocity " +
                  vector_text(velocity) + " m/s and the displacement " + vector_text(displacement) + " m");
}

}  // namespace

std::vector<std::string> notes_on_records(const Scene& scene) {
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < scene.quakes.size(); ++k)
    add_note("[[quake]] " + std::to_string(k), scene.quakes[k].acceleration.history, notes);
  for (std::size_t k = 0; k < scene.supports.size(); ++k)
    if (const TimeFunction& motion = scene.supports[k].displacement;
        motion.kind == TimeFunction::Kind::acceleration_history)
      add_note("[[support]] " + std::to_string(k), motion.history, notes);
  return notes;
}

}  // namespace ddacontact::scene_format
