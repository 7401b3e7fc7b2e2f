/// \file The keys of [domain]: part of schema.hpp.
#pragma once

#include <ddacontact/scene/key.hpp>
#include <ddacontact/scene/records.hpp>

namespace ddacontact::scene_format {

inline constexpr Key law_of_joint{.name = "joint",
                                  .what = "The `[[joint]]` that contacts there follow.",
                                  .default_text = "that of the materials"};
inline constexpr Bounds fraction{.low = 0, .high = 1};

template <class Visit>
void describe(SliverRecord& r, Visit&& visit) {
  visit(Key{.name = "area", .what = "Smaller blocks, of the mean area, are slivers.", .bounds = fraction},
        r.limits.area);
  visit(Key{.name = "angle",
            .what = "So are blocks with a sharper corner.",
            .unit = "deg",
            .bounds = {.low = 0, .high = 90}},
        r.limits.angle);
  visit(Key{.name = "policy",
            .what = "They go into the neighbour with the longest common edge, stay, or are an error."},
        r.policy);
}

template <class Visit>
void describe(JointSetRecord& r, Visit&& visit) {
  JointSet& s = r.set;
  visit(law_of_joint, r.joint);
  visit(Key{.name = "angle",
            .what = "Of the traces, counter-clockwise from x.",
            .unit = "deg",
            .required = true},
        s.angle);
  visit(Key{.name = "spacing",
            .what = "Between traces, normal to them.",
            .unit = "m",
            .bounds = positive,
            .required = true},
        s.spacing);
  visit(Key{.name = "trace", .what = "Length of a trace.", .unit = "m", .bounds = positive}, s.trace);
  visit(
      Key{.name = "gap",
          .what = "Rock bridge between two traces of one line; on the next line bridges are shifted by half "
                  "of trace and gap.",
          .unit = "m",
          .bounds = not_negative},
      s.gap);
  visit(Key{.name = "origin", .what = "The middle of a trace of a set without deviations.", .unit = "m"},
        s.origin);
  visit(Key{.name = "angle_deviation",
            .what = "Standard deviation of the angle, drawn for each trace.",
            .unit = "deg",
            .bounds = {.low = 0, .high = 90}},
        s.angle_deviation);
  visit(Key{.name = "spacing_deviation",
            .what = "Standard deviation of the spacing; at least a tenth of the mean is drawn.",
            .unit = "m",
            .bounds = not_negative},
        s.spacing_deviation);
  visit(Key{.name = "trace_deviation",
            .what = "Standard deviation of the length of traces; at least a tenth of the mean is drawn.",
            .unit = "m",
            .bounds = not_negative},
        s.trace_deviation);
  visit(Key{.name = "gap_deviation",
            .what = "Standard deviation of the rock bridges.",
            .unit = "m",
            .bounds = not_negative},
        s.gap_deviation);
  visit(Key{.name = "inside", .what = "The region it is in.", .default_text = "everywhere"}, r.inside);
}

template <class Visit>
void describe(TraceRecord& r, Visit&& visit) {
  visit(law_of_joint, r.joint);
  visit(Key{.name = "points", .what = "The joint runs from one to the next.", .unit = "m", .required = true},
        r.points);
}

template <class Visit>
void describe(VoronoiRecord& r, Visit&& visit) {
  visit(law_of_joint, r.joint);
  visit(Key{.name = "inside", .what = "The region that they fill.", .default_text = "the domain"}, r.inside);
  visit(Key{.name = "cells", .what = "How many.", .bounds = {.low = 1, .high = 1000000}, .required = true},
        r.cells);
}

template <class Visit>
void describe(RegionRecord& r, Visit&& visit) {
  visit(Key{.name = "name", .what = "Unique.", .required = true}, r.name);
  visit(Key{.name = "polygon",
            .what = "Blocks whose centroid lies in it belong to the region (a concave block without its "
                    "centroid: a point "
                    "inside it); of several regions the last one counts.",
            .unit = "m",
            .required = true},
        r.polygon);
  visit(Key{.name = "material", .what = "Of its blocks.", .default_text = "`domain.material`"}, r.material);
  visit(Key{.name = "model", .what = "Of its blocks.", .default_text = "`analysis.block_model`"}, r.model);
  visit(Key{.name = "fixed", .what = "Whether its blocks are held.", .default_text = "`false`"}, r.fixed);
  visit(Key{.name = "group", .what = "That its blocks belong to."}, r.group);
  visit(Key{.name = "cut", .what = "Whether its outline is a joint."}, r.cut);
  visit(law_of_joint, r.joint);
}

template <class Visit>
void describe(CircleRecord& r, Visit&& visit) {
  visit(Key{.name = "centre", .what = "", .unit = "m", .required = true}, r.centre);
  visit(Key{.name = "radius", .what = "", .unit = "m", .bounds = positive, .required = true}, r.radius);
  visit(Key{.name = "edges", .what = "", .bounds = {.low = 3, .high = 1000}}, r.edges);
}

template <class Visit>
void describe(HorseshoeRecord& r, Visit&& visit) {
  visit(Key{.name = "floor", .what = "", .unit = "m", .required = true}, r.floor);
  visit(Key{.name = "width", .what = "", .unit = "m", .bounds = positive, .required = true}, r.width);
  visit(Key{.name = "height", .what = "", .unit = "m", .bounds = positive, .required = true}, r.height);
  visit(Key{.name = "edges", .what = "", .bounds = {.low = 2, .high = 1000}}, r.edges);
}

template <class Visit>
void describe(OpeningRecord& r, Visit&& visit) {
  visit(Key{.name = "name", .what = "Unique; the group that the blocks inside belong to.", .required = true},
        r.name);
  visit(Key{.name = "circle",
            .what = "A regular polygon of `edges` (24) edges, its corners on the circle.",
            .default_text = "one of the three is required"},
        r.circle);
  visit(Key{.name = "horseshoe",
            .what = "A floor, with its middle at `floor`, walls, and half a circle of `edges` (12) edges.",
            .default_text = "one of the three is required"},
        r.horseshoe);
  visit(
      Key{.name = "polygon", .what = "Corners.", .unit = "m", .default_text = "one of the three is required"},
      r.polygon);
  visit(law_of_joint, r.joint);
  visit(Key{.name = "excavated", .what = "Whether it is empty from the start: no blocks inside."},
        r.excavated);
}

template <class Visit>
void describe(DomainRecord& r, Visit&& visit) {
  visit(Key{.name = "boundary",
            .what = "Corners of a polygon, or a drawing (.geojson, .json, .wkt, .dxf, .msh, .vtu, or Shi's "
                    ".geo), the "
                    "lines of which cut it.",
            .unit = "m",
            .required = true},
        r.boundary);
  visit(Key{.name = "material", .what = "Of all blocks.", .default_text = "the first"}, r.material);
  visit(Key{.name = "seed", .what = "The same seed gives the same blocks.", .bounds = not_negative}, r.seed);
  visit(
      Key{.name = "sliver",
          .what =
              "Blocks too small or too sharp, and what `policy` does with them: `merge`, `keep` or `refuse`.",
          .default_text = "`{ area = 0.001, angle = 5.0, policy = \"merge\" }`"},
      r.sliver);
  visit(Key{.name = "t_vertices",
            .what = "Whether the block beyond the end of a joint gets a vertex there, on its edge."},
        r.t_vertices);
  visit(
      Key{.name = "snap",
          .what = "Vertices nearer to each other become one; single joints are made longer by twice that, so "
                  "that they reach the line at which they were meant to end.",
          .unit = "m",
          .bounds = positive,
          .default_text = "1e-6 of the size of a block"},
      r.snap);
  visit(Key{.name = "joint_set", .what = "Parallel joints."}, r.joint_sets);
  visit(Key{.name = "trace", .what = "Single joints."}, r.traces);
  visit(Key{.name = "voronoi", .what = "Cells."}, r.voronoi);
  visit(Key{.name = "region", .what = "Materials, models and groups by place."}, r.regions);
  visit(Key{.name = "opening", .what = "What is, or will be, taken out."}, r.openings);
}

}  // namespace ddacontact::scene_format
