#pragma once
// read_deck from the inside: keyword lines (reader.cpp), *KEYWORD
// (format_reader.cpp), *INCLUDE and its kin (include_reader.cpp),
// *PARAMETER and its kin (parameter_reader.cpp). The cards of all other keywords are read by CardReader.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "keyword/help/controlled_physics.hpp"
#include "keyword/help/families.hpp"
#include "keyword/help/refusal_log.hpp"
#include "keyword/read/card_reader.hpp"

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
  Treatment note_request(const File& file, std::size_t line, const KeywordLine& keyword,
                         const Location& where);
  void close_requests();
  /// Of the card at which `data` is, with the value of a parameter; empty: there is none.
  std::string first_field(const DataLines& data, const KeywordLine& keyword);
  bool refuse_encrypted(const File& file, std::size_t line, const KeywordLine& keyword);
  void check_end(const File& file);
  void note_refused(const File& file, std::size_t line, const std::string& name, KeywordUse& use);
  const Families& families();
  void read_title(const File& file, std::size_t line);
  void warn_of_more_lines(const File& file, DataLines data, const std::string& name);
  std::shared_ptr<SourceText> load(const std::string& path) const;
  Location place(const File& file, std::size_t line, int column = 1) const {
    return deck_.location(file.index, static_cast<int>(line) + 1, column);
  }

  // refused_definitions.cpp
  /// Whether it is one that is not supported: close_definitions() refuses it if something refers to it.
  bool defer_definition(const File& file, std::size_t line, const KeywordLine& keyword);
  void close_definitions();

  // format_reader.cpp
  bool read_keyword_keyword(const File& file, std::size_t line, const KeywordLine& keyword);
  void read_format(const File& file, const KeywordLine& keyword, const Location& where);

  // parameter_reader.cpp
  bool read_parameter_keyword(const File& file, std::size_t line, const KeywordLine& keyword);
  struct ExpressionPiece {
    std::size_t offset = 0;  ///< in the expression as a whole
    std::size_t line = 0, column = 0;
  };
  void read_parameters(const File& file, std::size_t line, CardFormat format, bool typed,
                       Parameters::Definition& definition);
  void read_parameter_expressions(const File& file, std::size_t line, CardFormat format,
                                  Parameters::Definition& definition);
  void refuse_text_behind(const File& file, std::size_t line, std::size_t columns, std::string_view keyword);

  // include_reader.cpp
  bool read_include_keyword(const File& file, std::size_t line, const KeywordLine& keyword);
  void read_includes(const File& file, std::size_t line);
  void read_include_paths(const File& file, std::size_t line, bool relative_to_deck);
  void read_include_transform(const File& file, std::size_t line, const KeywordLine& keyword);
  /// `keyword`: the keyword that names the file, for messages.
  void include(const std::string& name, const File& from, std::size_t line, const Conversion& conversion,
               const char* keyword);
  std::shared_ptr<SourceText> load_once(const std::string& path);
  bool may_include(const std::string& path, const Location& where, const char* keyword);
  std::vector<std::string> candidates(const std::string& name, const std::string& including) const;

  Deck deck_;
  Diagnostics& diagnostics_;
  const ReadOptions& options_;
  Parameters parameters_;
  CardReader cards_;
  KeywordIndex index_;
  std::vector<std::string> open_files_;                         // from the deck to the file being read
  std::vector<std::string> include_paths_;                      // in the order of the deck
  std::map<std::string, std::shared_ptr<SourceText>> sources_;  // of included files, by path
  std::size_t distinct_bytes_ = 0, reread_bytes_ = 0;
  bool too_many_files_ = false;
  std::optional<Families> families_;
  RefusalLog refusals_;
  /// A request for output without a table, whose interval may be beyond the end of the run.
  struct Request {
    std::string name{};
    Location where{};
    Real interval = 0;  ///< [T]
  };
  std::vector<Request> requests_;
  struct Definition {
    std::string name{};
    Location where{};
    IdSpace space = IdSpace::none;
    Id id = 0;
  };
  std::vector<Definition> definitions_;
  HeldControls controls_;
};

}  // namespace courant
