// Memory that fails anywhere in a step: the step has not been made, or the failure is passed on.
#include <ddacontact/scene/builder.hpp>
#include <tests/support/random_scenes.hpp>

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

namespace {

/// Requests that are granted before one fails; < 0: none fails.
long granted = -1;
bool has_failed = false;

void* request(std::size_t size) {
  if (granted >= 0 && granted-- == 0) {
    has_failed = true;
    throw std::bad_alloc();
  }
  if (void* place = std::malloc(size > 0 ? size : 1)) return place;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
  return request(size);
}
void* operator new[](std::size_t size) {
  return request(size);
}
void operator delete(void* place) noexcept {
  std::free(place);
}
void operator delete[](void* place) noexcept {
  std::free(place);
}
void operator delete(void* place, std::size_t) noexcept {
  std::free(place);
}
void operator delete[](void* place, std::size_t) noexcept {
  std::free(place);
}

using namespace ddacontact;

namespace {

enum class End { made, refused, thrown };

End step_with(Stepper& stepper, long requests) {
  granted = requests;
  has_failed = false;
  try {
    const bool made = stepper.step();
    granted = -1;
    return made ? End::made : End::refused;
  } catch (const std::bad_alloc&) {
    granted = -1;
    return End::thrown;
  }
}

TEST(OutOfMemory, AStepIsLeftAsIfItHadNotBeenTried) {
  const Scene scene = support::random_drop(static_cast<std::uint64_t>(support::DropKind::wall));
  const BuiltScene whole = build(scene);
  ASSERT_TRUE(whole.stepper->step());
  const std::string before = to_bytes(whole.stepper->run_record());
  ASSERT_TRUE(whole.stepper->step());
  const std::string after = to_bytes(whole.stepper->run_record());
  ASSERT_TRUE(whole.stepper->step());
  const Points next_positions = whole.stepper->state().position;

  int n_refused = 0, n_without_velocity = 0;
  for (long requests = 0;; requests += 1 + requests / 80) {
    const BuiltScene built = build(scene);
    ASSERT_TRUE(built.stepper->step());
    built.stepper->restore(built.stepper->run_record());  // without the solution that was looked for ahead
    const End end = step_with(*built.stepper, requests);
    if (end == End::thrown) continue;
    if (end == End::made) {
      if (!has_failed) break;
      if (built.stepper->counts().unknown_velocities == 0) continue;  // what only saves time
      ++n_without_velocity;
      ASSERT_TRUE(built.stepper->step());
      EXPECT_TRUE(built.stepper->state().position == next_positions) << requests;
      continue;
    }
    ++n_refused;
    EXPECT_EQ(built.stepper->stop_reason().rfind("out of memory with ", 0), 0u);
    EXPECT_TRUE(to_bytes(built.stepper->run_record()) == before) << requests;
    const BuiltScene resumed = build(scene);
    resumed.stepper->restore(built.stepper->run_record());
    ASSERT_TRUE(resumed.stepper->step());
    EXPECT_TRUE(to_bytes(resumed.stepper->run_record()) == after) << requests;
  }
  EXPECT_GT(n_refused, 10);
  EXPECT_GT(n_without_velocity, 5);
}

}  // namespace
