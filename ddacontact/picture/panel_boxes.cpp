#include <ddacontact/picture/panel_boxes.hpp>

#include <algorithm>
#include <map>

namespace ddacontact {

namespace {

constexpr double margin = 0.01, comparable = 0.5;

double larger_side(const Window& box) {
  return std::max(box.width(), box.height());
}

}  // namespace

PanelBoxes fit_boxes(const std::vector<Window>& needed, const std::vector<int>& scenes) {
  Window all = needed.front();
  std::map<int, Window> of_scene;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    all = united(all, needed[i]);
    const auto [point, is_new] = of_scene.emplace(scenes[i], needed[i]);
    if (!is_new) point->second = united(point->second, needed[i]);
  }
  PanelBoxes fit;
  for (const auto& [scene, box] : of_scene)
    if (larger_side(box) < comparable * larger_side(all)) fit.same_scale = false;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    fit.boxes.push_back(padded(fit.same_scale ? all : of_scene.at(scenes[i]), margin));
    const Window& box = fit.boxes.back();
    fit.extents.push_back(Vec2(box.width(), box.height()) / fit.unit(i));
  }
  return fit;
}

}  // namespace ddacontact
