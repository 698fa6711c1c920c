#pragma once
// Keywords without a table: the families of their names, so that a deck is refused with the reason.
#include <string>
#include <utility>
#include <vector>

namespace courant {

/// Requests that have no influence on the physics: read over with a warning instead of an error.
bool is_output_request(const std::string& name);

/// First words of those requests.
std::vector<std::string> output_requests();

/// Why a keyword changes nothing in any deck that is accepted, so that it is read over with a note; null: it
/// may.
const char* why_without_effect(const std::string& name);

/// First words of those keywords.
std::vector<std::string> keywords_without_effect();
/// First words of the keywords that are refused, and what is lacking: "airbags"; "this ..." where some with
/// these words are supported.
std::vector<std::pair<std::string, std::string>> refused_families();

/// Why a keyword is refused.
struct Refusal {
  std::string lacking;  ///< "airbags", "this material (elastic)"; empty: the name is not known at all
  std::string hint;
};

/// Looks names up among the families of LS-DYNA's keywords.
class Families {
 public:
  /// `supported`: names with a table that are honoured, `read`: names whose cards are read and then refused.
  Families(std::vector<std::string> supported, std::vector<std::string> read);
  /// With the names of the registry.
  Families();

  /// `name`: in upper case, without '*' and without a table. Names near to one that has a table are taken for
  /// slips of the pen, unless they are known.
  Refusal refusal(const std::string& name) const;
  /// "did you mean ...?" where `name` is at most so many edits from one that has a table; else empty.
  std::string slip(const std::string& name, std::size_t most) const;

 private:
  std::string base_of(const std::string& name, const std::vector<std::string>& names) const;
  Refusal option(const std::string& name, const std::string& base) const;
  std::string supported_beginning_with(const std::string& prefix) const;

  std::vector<std::string> supported_, read_;
};

/// "airbags are not supported", "this material (elastic) is not supported".
std::string not_supported(const std::string& lacking);

}  // namespace courant
