/// \file What the model "auto" is for a block: the cheapest one that is valid for it.
///
/// 1. By shape: Wachspress functions where every corner turns left by more than two degrees, else mean value
///    functions.
/// 2. A block is divided into cells where bending matters: where more than 3 % of the stress (in the energy
///    norm, of that block or of a tenth of the largest energy density in the scene, whichever is larger) is
///    bending, stress along the block and linear across it, that its forces ask for and the polygon does not
///    carry. The forces are those of a first look at every stage of the scene at rest, and of another one
///    with the meshes chosen, at most three.
/// 3. A block is slender when its principal radii of gyration differ by a factor of more than 2.5. One
///    polygon cannot bend then: a rectangle of 4:1 has 15 % of the compliance of a beam. It gets four cells
///    across (400 cells at most). Where the first look finds no forces on it (it falls, or waits for others),
///    it is divided. Others get two cells across, only where forces are known, and only if all stages are
///    static: what bending does to how a squat block moves is small against what its mesh costs in each step.
/// 4. Meshes of slender blocks have 200 000 unknowns at most in all and those of others 4 000: where that is
///    not enough none of them is divided. What many blocks carry together depends little on how each bends.
#pragma once

#include <ddacontact/scene/first_loading.hpp>
#include <ddacontact/scene/scene.hpp>

#include <functional>
#include <string>
#include <vector>

namespace ddacontact {

/// A scene that states every model.
struct ChosenModels {
  Scene scene;
  std::vector<std::string> reasons;  ///< of every block: why it has its model; empty: the user chose it
};

/// Puts models in the place of "auto". `missing` finds what `missing_bending` says of a scene that states
/// every model; it is asked at most three times.
ChosenModels choose_models(
    const Scene& scene,
    const std::function<std::vector<double>(const Scene&, const std::vector<std::string>&)>& missing);

/// The ratio of the principal radii of gyration, >= 1.
double slenderness(const PointsRef& outline);
/// Whether an automatic block of this outline may be divided in a run that is not static throughout.
bool may_bend_in_motion(const PointsRef& outline);

/// What of the stress in each block is missing, relative as in rule 3; negative: no forces are known on it.
std::vector<double> missing_bending(const BlockSystem& blocks, const BlockState& initial,
                                    const FirstLoading& loading);

}  // namespace ddacontact
