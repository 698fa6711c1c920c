#pragma once
// Named structure-of-arrays fields. A field is registered once; output, restart, sorting and the exchange
// with ghost particles iterate over the registry, so a new field appears there without any edit.
#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "base/real.hpp"
#include "parallel/array.hpp"
#include "parallel/parallel.hpp"
#include "state/access.hpp"

namespace courant {

struct FieldInfo {
  std::string name;
  std::string dimension;  ///< in M, L, T, "-" for a pure number: "M/L3", "L/T"
  int components = 1;     ///< 1, 3 (vector) or 6 (symmetric tensor: xx yy zz xy yz zx)
  bool output = false;    ///< written to the field files
  bool restart = true;    ///< needed to continue a run bitwise
  bool exchange = false;  ///< neighbours that are copies of entities elsewhere (ghost particles) have it, too
  bool may_begin_later = false;  ///< 0 where a restart file lacks it
};

class FieldBase : public Resource {
 public:
  explicit FieldBase(FieldInfo info, const std::string& set = "")
      : Resource(info.name, set), info_(std::move(info)) {}
  const FieldInfo& info() const { return info_; }
  const FieldBase* field() const override { return this; }
  virtual void resize(Index n) = 0;
  /// Allocates `ghosts` entities behind the n existing ones; their values are not set.
  virtual void make_room(Index n, Index ghosts) = 0;
  /// Resizes the spare, a field of the same type with one component, to the number of entities of this field;
  /// values are not set.
  virtual void fit(FieldBase& spare) const = 0;
  /// Entities from[begin], ..., from[end - 1] of a component become [begin, end) of the spare.
  virtual void gather(int component, const Index* from, Index begin, Index end, FieldBase& spare) const = 0;
  /// Copies entities [begin, end) of the spare to a component.
  virtual void take(int component, Index begin, Index end, const FieldBase& spare) = 0;
  /// The spare becomes the component, and reversed.
  virtual void swap(int component, FieldBase& spare) = 0;
  virtual std::size_t bytes_per_entity() const = 0;

 private:
  FieldInfo info_;
};

/// `components` arrays of n values.
template <class T>
class Field : public FieldBase {
 public:
  explicit Field(FieldInfo info, const std::string& set = "")
      : FieldBase(info, set), component_(info.components) {}

  T* data(int component = 0) { return values(component); }
  const T* data(int component = 0) const { return values(component); }
  T& operator[](Index i) { return values(0)[i]; }
  const T& operator[](Index i) const { return values(0)[i]; }

  /// Component access as a vector, for fields of three components. shape: 3
  Vec vec(Index i) const { return {values(0)[i], values(1)[i], values(2)[i]}; }
  void set(Index i, const Vec& value) {
    for (int k = 0; k < 3; ++k) values(k)[i] = value[k];
  }
  void add(Index i, const Vec& value) {
    for (int k = 0; k < 3; ++k) values(k)[i] += value[k];
  }
  /// The same as a symmetric tensor, for fields of six components.
  Matrix tensor(Index i) const {
    const auto c = [&](int k) { return values(k)[i]; };
    Matrix t;
    t << c(0), c(3), c(5), c(3), c(1), c(4), c(5), c(4), c(2);
    return t;
  }
  void set_tensor(Index i, const Matrix& t) {
    const Real value[6] = {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
    for (int k = 0; k < 6; ++k) values(k)[i] = value[k];
  }
  void fill(T value) {
    for (int k = 0; k < info().components; ++k)
      std::fill(values(k), values(k) + component_[static_cast<std::size_t>(k)].size(), value);
  }

  /// New entities are zero; the threads that will work on them touch them first.
  void resize(Index n) override {
    for (auto& c : component_) {
      const auto old = static_cast<Index>(c.size());
      c.resize(n);
      for_each_block(n, [&](Index begin, Index end) {
        std::fill(c.data() + std::clamp(old, begin, end), c.data() + end, T(0));
      });
    }
  }
  void make_room(Index n, Index ghosts) override {
    for (auto& c : component_) {
      if (c.capacity() < static_cast<std::size_t>(n + ghosts)) c.reserve(n + ghosts + ghosts / 4);
      c.resize(n + ghosts);
    }
  }
  void fit(FieldBase& spare) const override {
    Array<T>& to = of(spare);
    if (to.capacity() < component_[0].size()) {
      to.clear();  // nothing of it need be moved
      to.reserve(component_[0].capacity());
    }
    to.resize(component_[0].size());
  }
  void gather(int component, const Index* from, Index begin, Index end, FieldBase& spare) const override {
    const T* values = component_[component].data();
    T* to = of(spare).data();
    for (Index i = begin; i < end; ++i) to[i] = values[from[i]];
  }
  void take(int component, Index begin, Index end, const FieldBase& spare) override {
    const T* values = static_cast<const Field<T>&>(spare).data();
    std::copy(values + begin, values + end, component_[component].data() + begin);
  }
  void swap(int component, FieldBase& spare) override { component_[component].swap(of(spare)); }
  std::size_t bytes_per_entity() const override { return sizeof(T) * component_.size(); }

 private:
  static Array<T>& of(FieldBase& spare) { return static_cast<Field<T>&>(spare).component_[0]; }
  T* values(int component) {
    note_access(*this);
    return component_[component].data();
  }
  const T* values(int component) const {
    note_access(*this);
    return component_[component].data();
  }
  std::vector<Array<T>> component_;
};

/// An entity set: the fields of one kind of entity (particles, nodes, segments, elements of a group, bodies);
/// all have the same length. Passes run over the blocks of a set.
class FieldSet {
 public:
  explicit FieldSet(std::string name) : name_(std::move(name)) {}
  const std::string& name() const { return name_; }
  /// Registers a field, or returns the one of that name. Throws std::logic_error on a clash of type.
  template <class T>
  Field<T>& add(FieldInfo info) {
    if (FieldBase* old = find(info.name)) {
      auto* same = dynamic_cast<Field<T>*>(old);
      if (!same) throw std::logic_error("field '" + info.name + "' is registered with another type");
      return *same;
    }
    auto field = std::make_unique<Field<T>>(std::move(info), name_);
    field->resize(size_);
    Field<T>& out = *field;
    fields_.push_back(std::move(field));
    auto& spare = spare_[typeid(Field<T>)];
    if (!spare) spare = std::make_unique<Field<T>>(FieldInfo{.name = "spare", .dimension = "-"});
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
  /// Allocates `count` ghosts behind the entities in all fields that are exchanged. Arrays may move in
  /// memory.
  void make_room_for_ghosts(Index count) {
    for (auto& f : fields_)
      if (f->info().exchange) f->make_room(size_, count);
  }
  /// New entity i is old entity old_of_new[i], for as many as are given; the rest are unchanged. Each thread
  /// sorts the entities that it processes afterwards, so they are in its cache. Arrays move in memory.
  void permute(std::span<const Index> old_of_new) {
    const Index n = static_cast<Index>(old_of_new.size());
    for (const auto& field : fields_) {
      const FieldBase& kind = *field;
      const auto& spare = spare_.at(typeid(kind));
      for (int k = 0; k < field->info().components; ++k) {
        field->fit(*spare);
        for_each_block(
            n, [&](Index begin, Index end) { field->gather(k, old_of_new.data(), begin, end, *spare); });
        if (n == size_)
          field->swap(k, *spare);
        else  // mostly few of many
          for_each_block(n, [&](Index begin, Index end) { field->take(k, begin, end, *spare); });
      }
    }
  }
  /// Memory of one more entity: its fields and those for sorting.
  std::size_t bytes_per_entity() const {
    std::size_t bytes = 0;
    for (const auto& f : fields_) bytes += f->bytes_per_entity();
    for (const auto& [type, spare] : spare_) bytes += spare->bytes_per_entity();
    return bytes;
  }
  const std::vector<std::unique_ptr<FieldBase>>& all() const { return fields_; }

 private:
  std::string name_;
  Index size_ = 0;
  std::vector<std::unique_ptr<FieldBase>> fields_;
  std::map<std::type_index, std::unique_ptr<FieldBase>> spare_;  ///< of each type, for sorting
};

}  // namespace courant
