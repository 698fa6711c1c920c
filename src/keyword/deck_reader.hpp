#pragma once
// read_deck from the inside: keyword lines (reader.cpp), *INCLUDE and its kin (include_reader.cpp),
// *PARAMETER and its kin (parameter_reader.cpp). The cards of all other keywords are read by CardReader.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "keyword/card_reader.hpp"
#include "keyword/families.hpp"
#include "keyword/refusal_log.hpp"

namespace courant {

class DeckReader {
 public:
  DeckReader(const ReadOptions& options, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        options_(options),
        parameters_(options),
        cards_(deck_, parameters_, diagnostics) {}

  Deck read(const std::string& path);

 private:
  struct File {
    std::int32_t index = 0;
    std::shared_ptr<SourceText> source;
  };

  // reader.cpp
  void read_file(DeckFile deck_file, std::shared_ptr<SourceText> source);
  std::size_t skip_text_before_keywords(const File& file);
  bool read_keyword(const File& file, std::size_t line);  // true at *END
  bool read_deck_keyword(const File& file, std::size_t line, const KeywordLine& keyword);
  Treatment read_cards(const File& file, std::size_t line, const KeywordLine& keyword);
  Treatment refuse(const std::string& name, const Location& where);
  void note_refused(const File& file, std::size_t line, const std::string& name, KeywordUse& use);
  const Families& families();
  void read_format(const File& file, const KeywordLine& keyword, const Location& where);
  void read_title(const File& file, std::size_t line);
  std::shared_ptr<SourceText> load(const std::string& path) const;
  Location place(const File& file, std::size_t line, int column = 1) const {
    return deck_.location(file.index, static_cast<int>(line) + 1, column);
  }

  // parameter_reader.cpp
  bool read_parameter_keyword(const File& file, std::size_t line, const KeywordLine& keyword);
  void read_parameters(const File& file, std::size_t line, CardFormat format);

  // include_reader.cpp
  bool read_include_keyword(const File& file, std::size_t line, const KeywordLine& keyword);
  void read_includes(const File& file, std::size_t line);
  std::string read_file_name(DataLines& data) const;
  void include(const std::string& name, const File& from, std::size_t line, const Conversion& conversion);

  Deck deck_;
  Diagnostics& diagnostics_;
  const ReadOptions& options_;
  Parameters parameters_;
  CardReader cards_;
  KeywordIndex index_;
  std::optional<Families> families_;
  RefusalLog refusals_;
  std::vector<std::string> open_files_;  // from the deck to the file being read
  std::map<std::pair<int, int>, Location> seen_;
};

}  // namespace courant
