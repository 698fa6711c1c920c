#pragma once
// Sends the states of a run through the analyses of a recipe, one after the other.
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "post/analysis.hpp"
#include "post/results.hpp"

namespace courant {

/// Somebody who looks at states. `frame` is gone after the call.
struct StateReader {
  std::function<bool(std::size_t state)> wants{};        ///< whether it looks at that state
  std::function<bool(std::size_t state)> wants_speed{};  ///< ParticleFrame::speed, too
  std::function<void(std::size_t state, const ParticleFrame& frame)> take{};
};

/// Reads each state that somebody wants once, the next one while the present one is looked at, so that two
/// are in memory at most. `progress` gets a line now and then. Returns false where a state cannot be read.
bool stream_states(const std::vector<StateFiles>& states, const std::vector<StateReader>& readers,
                   const std::vector<ParticleArray>& arrays,
                   const std::function<void(const std::string&)>& progress, Diagnostics& diagnostics);

/// A reader for all analyses that look at states; `folder` must outlive it.
StateReader analysis_reader(const std::vector<std::unique_ptr<Analysis>>& analyses,
                            const std::vector<StateFiles>& states, const std::filesystem::path& folder);

/// Makes the results and writes CSV, HDF5 (tables.h5) and .vti files to `folder`; what they say goes to
/// `say`. `dir`: the run's folder. Throws OutputError.
void finish_analyses(const std::vector<std::unique_ptr<Analysis>>& analyses, const std::filesystem::path& dir,
                     const std::filesystem::path& folder, const std::function<void(std::string_view)>& say,
                     Diagnostics& diagnostics);

}  // namespace courant
