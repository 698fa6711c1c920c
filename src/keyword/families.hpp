#pragma once
// Keywords that Courant does not read: what their names tell.
#include <string>

namespace courant {

/// Requests that have no influence on the physics: read over with a warning instead of an error.
bool is_output_request(const std::string& name);

}  // namespace courant
