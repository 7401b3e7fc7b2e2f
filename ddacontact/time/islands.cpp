#include <ddacontact/time/islands.hpp>

namespace ddacontact {

int Islands::first_movable(const AffineForm& form) const {
  for (int u : form.unknowns())
    if (blocks_->is_movable(blocks_->block_of_unknown(u))) return blocks_->block_of_unknown(u);
  return -1;
}

void Islands::join(int a, int b) {
  if (blocks_->is_movable(a) && blocks_->is_movable(b)) sets_.join(a, b);
}

void Islands::join(const AffineForm& form) {
  const int first = first_movable(form);
  for (int u : form.unknowns())
    if (const int b = blocks_->block_of_unknown(u); blocks_->is_movable(b)) sets_.join(b, first);
}

void Islands::hit(const AffineForm& form) {
  if (const int b = first_movable(form); b >= 0) hit_.insert(root(b));
}

bool Islands::is_hit(const AffineForm& form) const {
  const int b = first_movable(form);
  return b >= 0 && hit_.contains(root(b));
}

std::vector<int> Islands::hit_blocks() const {
  std::vector<int> blocks;
  for (int b = 0; b < blocks_->n_blocks(); ++b)
    if (blocks_->is_movable(b) && hit_.contains(root(b))) blocks.push_back(b);
  return blocks;
}

}  // namespace ddacontact
