// *PARAMETER and its kin.
#include "keyword/deck_reader.hpp"

namespace courant {

bool DeckReader::read_parameter_keyword(const File& file, std::size_t line, const KeywordLine& keyword) {
  if (keyword.name != "PARAMETER") return false;
  read_parameters(file, line, keyword.format);
  return true;
}

void DeckReader::read_parameters(const File& file, std::size_t line, CardFormat format) {
  const int width = format == CardFormat::long_fields ? 20 : 10;
  for (DataLines data(*file.source, line + 1); !data.done(); data.step()) {
    const std::vector<Slice> slices = split_equal(data.line(), width, 8 * width);
    for (std::size_t i = 0; i < slices.size(); i += 2) {
      if (slices[i].text.empty()) continue;
      parameters_.define(slices[i].text, i + 1 < slices.size() ? slices[i + 1].text : std::string_view{},
                         place(file, data.index(), slices[i].column), diagnostics_);
    }
  }
}

}  // namespace courant
