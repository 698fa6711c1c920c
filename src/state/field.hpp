#pragma once
// Named structure-of-arrays fields. A field is registered once; output, restart, sorting and (later) ghost
// exchange walk the registry, so a new field appears there without any edit.
#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/real.hpp"
#include "parallel/array.hpp"
#include "parallel/parallel.hpp"

namespace courant {

struct FieldInfo {
  std::string name;
  std::string dimension;  ///< in M, L, T, "-" for a pure number: "M/L3", "L/T"
  int components = 1;     ///< 1 or 3
  bool output = false;    ///< written to the field files
  bool restart = true;    ///< needed to continue a run bitwise
  bool exchange = false;  ///< needed on ghosts
};

/// One spare array per type of number that a field may hold, shared by the fields of a set for sorting.
using FieldScratch = std::tuple<Array<Real>, Array<Id>, Array<Index>>;

class FieldBase {
 public:
  explicit FieldBase(FieldInfo info) : info_(std::move(info)) {}
  virtual ~FieldBase() = default;
  const FieldInfo& info() const { return info_; }
  virtual void resize(Index n) = 0;
  virtual void permute(std::span<const Index> old_of_new, FieldScratch& scratch) = 0;
  virtual std::size_t bytes_per_entity() const = 0;

 private:
  FieldInfo info_;
};

/// `components` arrays of `n + 1` values: the last one is the padding entity, always zero unless a physics
/// sets it, which neighbour lists use to fill up vectors.
template <class T>
class Field : public FieldBase {
 public:
  explicit Field(FieldInfo info) : FieldBase(info), component_(info.components) {}

  T* data(int component = 0) { return component_[component].data(); }
  const T* data(int component = 0) const { return component_[component].data(); }
  T& operator[](Index i) { return component_[0][i]; }
  const T& operator[](Index i) const { return component_[0][i]; }

  /// Component access as a vector, for fields of three components. shape: 3
  Vec vec(Index i) const { return {component_[0][i], component_[1][i], component_[2][i]}; }
  void set(Index i, const Vec& value) {
    for (int k = 0; k < 3; ++k) component_[k][i] = value[k];
  }
  void add(Index i, const Vec& value) {
    for (int k = 0; k < 3; ++k) component_[k][i] += value[k];
  }
  void fill(T value) {
    for (auto& c : component_) std::fill(c.begin(), c.end() - 1, value);
  }

  /// New entities are zero; the threads that will work on them touch them first.
  void resize(Index n) override {
    for (auto& c : component_) {
      const auto old = static_cast<Index>(c.size());
      c.resize(n + 1);
      for_each_block(n + 1, [&](Index begin, Index end) {
        std::fill(c.data() + std::clamp(old, begin, end), c.data() + end, T(0));
      });
    }
  }
  void permute(std::span<const Index> old_of_new, FieldScratch& scratch) override {
    auto& spare = std::get<Array<T>>(scratch);
    const auto n = static_cast<Index>(old_of_new.size());
    for (auto& c : component_) {
      spare.resize(c.size());
      for_each_block(n, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) spare[i] = c[old_of_new[i]];
      });
      std::copy(c.begin() + n, c.end(), spare.begin() + n);
      c.swap(spare);
    }
  }
  std::size_t bytes_per_entity() const override { return sizeof(T) * component_.size(); }

 private:
  std::vector<Array<T>> component_;
};

/// The fields of one kind of entity (particles, nodes, segments); all have the same length.
class FieldSet {
 public:
  /// Registers a field, or returns the one of that name. Throws std::logic_error on a clash of type.
  template <class T>
  Field<T>& add(FieldInfo info) {
    if (FieldBase* old = find(info.name)) {
      auto* same = dynamic_cast<Field<T>*>(old);
      if (!same) throw std::logic_error("field '" + info.name + "' is registered with another type");
      return *same;
    }
    auto field = std::make_unique<Field<T>>(std::move(info));
    field->resize(size_);
    Field<T>& out = *field;
    fields_.push_back(std::move(field));
    return out;
  }
  FieldBase* find(const std::string& name) const {
    for (const auto& f : fields_)
      if (f->info().name == name) return f.get();
    return nullptr;
  }
  Index size() const { return size_; }
  void resize(Index n) {
    size_ = n;
    for (auto& f : fields_) f->resize(n);
  }
  /// New entity i is old entity old_of_new[i].
  void permute(std::span<const Index> old_of_new) {
    for (auto& f : fields_) f->permute(old_of_new, scratch_);
  }
  /// What one more entity takes: its fields and its share of the scratch for sorting.
  std::size_t bytes_per_entity() const {
    std::size_t bytes = std::apply([](const auto&... spare) { return (sizeof(spare[0]) + ...); }, scratch_);
    for (const auto& f : fields_) bytes += f->bytes_per_entity();
    return bytes;
  }
  const std::vector<std::unique_ptr<FieldBase>>& all() const { return fields_; }

 private:
  Index size_ = 0;
  std::vector<std::unique_ptr<FieldBase>> fields_;
  FieldScratch scratch_;
};

}  // namespace courant
