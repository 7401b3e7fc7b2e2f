#include "help_texts.hpp"

namespace dda {

namespace {

constexpr std::string_view units =
    R"(Units are SI (m, kg, s, N, Pa), angles in degrees. The thickness is 1 m: a load in N is one in N per metre.
x points right, y up; tension and counter-clockwise turns are positive.

A quantity may be a string with its unit: "35 MPa", "21 kN/m3", "5 cm", ["1 kN", -50.0].
  symbols   m g t s N Pa J Hz rad deg
  prefixes  k M G m c
  products, quotients and powers: kN/m3, kg/m/s2, N m-2
A unit of the wrong dimension is an error.
)";

constexpr std::string_view files = R"(dda run SCENE.toml writes SCENE-out/:
  summary.json                status, counts, unbalanced forces, energies, times
  monitors.csv, energy.csv    histories, a row a step
  blocks.csv, vertices.csv    position, motion and stress of every block at the end
  contacts.csv, supports.csv  contact forces and reactions at the end
  bolts.csv                   of a scene with bolts: forces of their segments at the end
  bolt_history.csv            of a scene with bolts: the largest force of each in time
  support_history.csv         of a scene with supports: their force on each block in time
  results.pvd, contacts.pvd   series for ParaView; their files are in frames/
  scene.toml, log.txt         the scene as run, every default written out; the log
  checkpoint.bin              dda run SCENE.toml --resume SCENE-out/checkpoint.bin goes on from there
An older SCENE-out/ is renamed SCENE-out.1, .2, ...; --force overwrites it.
)";

constexpr std::string_view statuses = R"(Exit statuses
  0    done
  2    the input or the call is wrong, or the scene needs more memory than there is; nothing is written
  3    the analysis stopped: a step could not be solved, even cut to a thousandth, or memory ran out;
       results and a checkpoint are kept
  4    a file could not be read or written
  130  interrupted by Ctrl-C; a run keeps results and a checkpoint, safety its trials, sweep its cases
  143  ended by a signal from the system; what is kept is the same

"status" of summary.json is "completed", "stopped" or "interrupted". A completed run need not be in equilibrium:
see "at_rest", "unbalanced" and the warnings.
)";

constexpr std::string_view schemes = R"(analysis.scheme integrates the equations of motion:
  "decaying"        the default; second order in rigid motion, damps vibration; stable at any step
  "explicit"        central differences, in substeps that the stiffest block allows; waves, impacts
  "midpoint"        keeps momentum, angular momentum and energy; comes to rest by friction or damping alone
  "newmark"         Newmark's method with beta and gamma; blocks that hardly turn
  "backward_euler"  damps vibration and rotation most of all; scenes that settle
  "dda"             Newmark with beta = 1/2, gamma = 1, as in the paper and in other DDA programs
mode = "static" starts every step at rest, to find equilibrium.
What each scheme conserves, with measurements: doc/scene_format.md, doc/verification/mechanics.md.
)";

}  // namespace

const std::vector<HelpText>& help_texts() {
  static const std::vector<HelpText> texts{
      {"units", units}, {"files", files}, {"statuses", statuses}, {"schemes", schemes}};
  return texts;
}

}  // namespace dda
