#include <ddacontact/picture/magnified.hpp>

namespace ddacontact {

Frame magnified(const Frame& frame, double factor) {
  if (frame.displacement.cols() != frame.position.cols())
    throw Error("the frame does not hold displacements to magnify");
  Frame larger = frame;
  larger.position += (factor - 1) * frame.displacement;
  for (FrameContact& contact : larger.contacts) {
    Index vertex = 0;
    (frame.outline(contact.vertex_block).colwise() - contact.position)
        .colwise()
        .squaredNorm()
        .minCoeff(&vertex);
    contact.position +=
        (factor - 1) * frame.displacement.col(frame.blocks[contact.vertex_block].first + vertex);
  }
  return larger;
}

}  // namespace ddacontact
