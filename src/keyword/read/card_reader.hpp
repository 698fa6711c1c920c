#pragma once
// Reads the data lines below one keyword into entries, by the keyword's table.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "keyword/help/refusal_log.hpp"
#include "keyword/read/parameters.hpp"
#include "keyword/read/table_lines.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"

namespace courant {

bool is_whole(FieldType type);
/// "an integer > 0"
std::string expectation(const FieldSpec& field);

class CardReader {
 public:
  /// Reading stops after this many errors.
  static constexpr int max_errors = 100;

  CardReader(Deck& deck, Parameters& parameters, Diagnostics& diagnostics)
      : deck_(deck), parameters_(parameters), all_(diagnostics) {}

  struct Block {
    std::int32_t file = 0;
    const SourceText* source = nullptr;
    std::size_t line = 0;  ///< index of the keyword line
    KeywordMatch match;
    CardFormat format = CardFormat::standard;
  };
  /// Faults of the cards go to `diagnostics`.
  void read(const Block& block, Diagnostics& diagnostics);
  /// Once the deck has been read: adds to messages where else they hold.
  void close() { undefined_.close(all_, "field"); }
  /// Entries read since the last call.
  std::size_t take_count() { return std::exchange(count_, 0); }
  bool full() const { return all_.errors() >= max_errors; }

 private:
  void find_end();
  bool only_blanks_left(const DataLines& data) const { return data.index() >= end_; }
  void read_set(DataLines& data, EntrySink& sink);
  void finish(EntrySink& sink);
  bool read_title_lines(DataLines& data, EntrySink& sink);
  void convert(EntrySink& sink);
  void read_id_line(std::string_view line, int number, EntrySink& sink);
  void read_cards(DataLines& data, EntrySink& sink);
  void refuse_second_definition(const Entry& entry);
  void read_card(const DataLines& data, std::size_t card, EntrySink& sink);
  void read_whole_line(const DataLines& data, std::size_t card, EntrySink& sink);
  bool begins_entry(std::string_view line);
  bool warn_of_cut_number(std::string_view line, const CardSpec& spec, std::size_t card);
  bool keeps_zeros(std::size_t card, const FieldSpec& spec) const;
  void read_field(std::size_t card, std::size_t field, Slice slice, EntrySink& sink);
  void fill_list(std::size_t card, const FieldSpec& spec, std::size_t field, EntrySink& sink);
  bool read_integer(std::size_t card, std::size_t field, const Slice& slice, EntrySink& sink);
  bool read_real(std::size_t card, std::size_t field, const Slice& slice, EntrySink& sink);
  /// Replaces "&name" or "<expression>" by its value; false if that failed. `held` keeps the text.
  bool substitute(std::size_t card, std::size_t field, Slice& slice, std::string& held);
  /// Replaces each &name of a text parameter; other names must be those of a whole field.
  bool substitute_texts(std::size_t card, std::size_t field, Slice& slice, std::string& held);
  void parameter_error(std::size_t card, std::size_t field, const Slice& slice,
                       const Parameters::Resolved& failed);
  /// False where the name that it misses was reported before.
  bool is_news(const Parameters::Resolved& failed);
  bool passes(std::size_t card, std::size_t field, const Slice& slice, Real value);
  bool is_allowed(std::size_t card, std::size_t field, const Slice& slice, Id value);
  void field_error(std::size_t card, std::size_t field, const Slice& slice, const std::string& message,
                   std::string hint = {}, bool contained = false);
  bool is_shifted(std::size_t card, const Slice& slice) const;
  void field_refused(std::size_t card, std::size_t field, const Slice& slice, std::string hint);
  void missing(const DataLines& data, const std::string& what);
  Location here(int column) const { return deck_.location(block_.file, line_, column); }

  Deck& deck_;
  Parameters& parameters_;
  Diagnostics& all_;                    ///< of the deck
  Diagnostics* diagnostics_ = nullptr;  ///< of the block
  Block block_;
  const KeywordSpec* spec_ = nullptr;
  int line_ = 0;         ///< number of the line being read
  std::size_t end_ = 0;  ///< index behind the last line of the block that is neither blank nor a comment
  std::size_t count_ = 0;
  std::string origin_;  ///< of the value of the field being read, if that is a parameter
  TableLines table_;
  std::string_view row_;  ///< the line being read
  int shifted_line_ = 0;  ///< the last one whose fields look shifted
  RefusalLog undefined_;  ///< parameters
  /// Faults of a field in a block, which many of its lines may have.
  struct FieldFaults {
    int shown = 0;
    std::string last{};
  };
  std::map<std::pair<std::size_t, std::size_t>, FieldFaults> faults_;  ///< by card and field
  RefusalLog repeated_;                                                ///< of the block
  std::vector<Slice> slices_;
};

}  // namespace courant
