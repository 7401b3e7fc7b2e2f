/// \file What the panels of a picture show, wherever they stand on the page.
#pragma once

#include <ddacontact/picture/field_layer.hpp>
#include <ddacontact/picture/legend.hpp>
#include <ddacontact/picture/picture.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace ddacontact {

/// Whether a field is drawn by a colour scale.
bool has_numbers(Field field);

/// One panel's field with its colours, and its vectors.
struct PanelContent {
  std::unique_ptr<FieldSamples> samples;  ///< of fields of numbers
  std::optional<ColourScale> scale;
  std::vector<std::vector<Arrow>> arrows;  ///< of each kind of the options
};

/// The contents of all panels, `columns` in a row, their colours shared as the options say.
/// \param[in] pixels_per_metre  of each panel
std::vector<PanelContent> make_contents(const std::vector<Panel>& panels, const PictureOptions& options,
                                        const std::vector<double>& pixels_per_metre, int columns);

/// How long the vectors of a kind are drawn in all panels.
struct VectorScale {
  VectorKind kind;
  double longest = 0;  ///< the largest vector
  double pixels_per_unit = 0;
};

/// The same scale for a kind in all panels.
/// \param[in] longest_pixels  for the largest vector of each kind
std::vector<VectorScale> vector_scales(const std::vector<PanelContent>& contents,
                                       const std::vector<VectorKind>& kinds, double longest_pixels);

/// The largest axial force of a bolt in any panel, N per m.
double largest_bolt_force(const std::vector<Panel>& panels);

/// What plain colours, bolts and vectors mean.
std::vector<LegendItem> explanations(const std::vector<Panel>& panels,
                                     const std::vector<PanelContent>& contents,
                                     const std::vector<VectorScale>& scales);

}  // namespace ddacontact
