#pragma once
#include <atomic>
#include <string>
#include <vector>

namespace courant {

/// The words of `courant verify`.
struct VerifyCall {
  std::string suite, dir, compare, page;
  std::vector<std::string> only;
  int jobs = 0;
  bool fresh = false;
};

/// Exit code: 0 all bounds are met; 1 the suite is wrong, nothing was run; 2 a bound is missed, or `stop` was
/// set; 3 the results cannot be written.
int call_verify(const VerifyCall& call, const std::atomic<bool>& stop);

}  // namespace courant
