#pragma once
#include <filesystem>

namespace courant {

/// Whether the numbers of points and of bytes that a VTK file in XML with raw appended data names can be in
/// it, compressed as far as any of its methods goes. VTK asks for memory by these numbers before it looks at
/// what they count, so those of a damaged file may ask for all there is. True for files of another form.
bool sizes_fit(const std::filesystem::path& file);

}  // namespace courant
