/// \file `dda make`: writes block geometry.
#pragma once

#include <ddacontact/scene/made_scenes.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dda {

/// What the options of `dda make KIND` say.
struct MakeArguments {
  std::string kind, file;
  std::vector<double> box{20.0, 10.0};  ///< width and height of the domain
  std::string domain;                   ///< "x,y x,y ..." instead of the box; empty: the box
  polyfem::VoronoiOptions voronoi;
  ddacontact::MadeSlope slope;
  ddacontact::MadeTunnel tunnel;
  ddacontact::MadeWall wall;
  ddacontact::MadeArch arch;
  ddacontact::MadeColumn column;
  ddacontact::MadeHeap heap;
};

/// Adds the verb with its kinds and their options.
void add_make(CLI::App& app, MakeArguments& arguments);

/// Returns the exit status.
int make(const MakeArguments& arguments);

}  // namespace dda
