#include <ddacontact/picture/panel_contents.hpp>

#include <algorithm>
#include <set>

namespace ddacontact {

namespace {

bool share_colours(std::size_t i, std::size_t j, const std::vector<Panel>& panels, RangeSharing sharing,
                   std::size_t columns) {
  if (panels[i].field != panels[j].field) return false;
  return i == j || sharing == RangeSharing::all ||
         (sharing == RangeSharing::rows && i / columns == j / columns);
}

struct Sample {
  Arrow::Look look;
  const char* text;
};

std::vector<Sample> samples_of(VectorKind kind) {
  switch (kind) {
    case VectorKind::contact_forces:
      return {{Arrow::Look::plain, "contact force"}, {Arrow::Look::slipping, "contact force, slipping"}};
    case VectorKind::principal_stresses:
      return {{Arrow::Look::compression, "compression"}, {Arrow::Look::tension, "tension"}};
    case VectorKind::velocity:
      return {{Arrow::Look::plain, "velocity"}};
    default:
      return {{Arrow::Look::plain, "displacement"}};
  }
}

bool any_drawn(const std::vector<PanelContent>& contents, std::size_t k, Arrow::Look look,
               double pixels_per_unit) {
  for (const PanelContent& content : contents)
    for (const Arrow& arrow : content.arrows[k])
      if (arrow.look == look && arrow.vector.norm() * pixels_per_unit >= 1) return true;
  return false;
}

}  // namespace

bool has_numbers(Field field) {
  const FieldKind kind = description(field).kind;
  return kind == FieldKind::magnitude || kind == FieldKind::with_sign;
}

std::vector<PanelContent> make_contents(const std::vector<Panel>& panels, const PictureOptions& options,
                                        const std::vector<double>& pixels_per_metre, int columns) {
  std::vector<PanelContent> contents(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    if (has_numbers(panel.field))
      contents[i].samples = std::make_unique<FieldSamples>(panel.shown_values(), panel.field,
                                                           pixels_per_metre[i], *panel.frame);
    for (const VectorKind kind : options.vectors) contents[i].arrows.push_back(arrows_of(*panel.frame, kind));
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (!contents[i].samples) continue;
    ValueRange data = contents[i].samples->range(), telling = contents[i].samples->telling_range();
    const auto include = [](ValueRange& range, const ValueRange& other) {
      range.low = std::min(range.low, other.low);
      range.high = std::max(range.high, other.high);
    };
    bool has_peaks = false;
    for (std::size_t j = 0; j < panels.size(); ++j)
      if (share_colours(i, j, panels, options.sharing, static_cast<std::size_t>(columns))) {
        include(data, contents[j].samples->range());
        include(telling, contents[j].samples->telling_range());
        has_peaks = has_peaks || contents[j].samples->has_peaks();
      }
    if (!options.range && is_one_value(telling, panels[i].field))
      data = telling;  // peaks on a uniform field are no field
    const ValueRange* shown = options.range ? &*options.range : telling == data ? nullptr : &telling;
    const bool by_percentiles = has_peaks && !options.range;
    contents[i].scale.emplace(panels[i].field, data, shown, by_percentiles ? "1\u201399 % of area" : "");
  }
  return contents;
}

std::vector<VectorScale> vector_scales(const std::vector<PanelContent>& contents,
                                       const std::vector<VectorKind>& kinds, double longest_pixels) {
  std::vector<VectorScale> scales;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    double longest = 0;
    for (const PanelContent& content : contents) longest = std::max(longest, largest(content.arrows[k]));
    scales.push_back({kinds[k], longest, longest > 0 ? longest_pixels / longest : 0});
  }
  return scales;
}

double largest_bolt_force(const std::vector<Panel>& panels) {
  double largest = 0;
  for (const Panel& panel : panels) largest = std::max(largest, largest_force(panel.bolts));
  return largest;
}

std::vector<LegendItem> explanations(const std::vector<Panel>& panels,
                                     const std::vector<PanelContent>& contents,
                                     const std::vector<VectorScale>& scales) {
  std::vector<LegendItem> items;
  std::set<int> materials;
  for (const Panel& panel : panels) {
    if (panel.field != Field::material) continue;
    for (const int material : panel.frame->materials)
      if (materials.insert(material).second)
        items.push_back(
            swatch(kind_colour(material), panel.frame->material_names[static_cast<std::size_t>(material)]));
  }
  std::vector<BoltLine> bolts;
  for (const Panel& panel : panels) bolts.insert(bolts.end(), panel.bolts.begin(), panel.bolts.end());
  for (LegendItem& item : bolt_explanations(bolts, largest_force(bolts))) items.push_back(std::move(item));
  for (std::size_t k = 0; k < scales.size(); ++k)
    for (const Sample& sample : samples_of(scales[k].kind))
      if (any_drawn(contents, k, sample.look, scales[k].pixels_per_unit))
        items.push_back(arrow_sample(scales[k].kind, sample.look, scales[k].longest,
                                     scales[k].pixels_per_unit, sample.text));
  return items;
}

}  // namespace ddacontact
