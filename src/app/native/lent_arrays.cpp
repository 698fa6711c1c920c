#include "app/native/lent_arrays.hpp"

#include <algorithm>
#include <stdexcept>

namespace courant::native {

namespace {

/// Calls `work` with the field as what it is.
template <class Work>
void with_type(FieldBase& field, const Work& work) {
  if (auto* reals = dynamic_cast<Field<Real>*>(&field)) return work(*reals);
  if (auto* indices = dynamic_cast<Field<Index>*>(&field)) return work(*indices);
  if (auto* ids = dynamic_cast<Field<Id>*>(&field)) return work(*ids);
  throw std::logic_error("field '" + field.info().name + "' has a type that numpy is not given");
}

}  // namespace

pybind11::array LentArrays::get(FieldBase& field, int component, Index n, Index ghosts) {
  std::shared_ptr<Lent>& lent = lent_[{&field, component}];
  if (!lent)
    lent = std::make_shared<Lent>(Lent{.field = &field, .component = component, .length = n + ghosts});
  pybind11::array out;
  with_type(field, [&](auto& typed) {
    auto* holder = new std::shared_ptr<Lent>(lent);
    const pybind11::capsule owner(holder, [](void* it) { delete static_cast<std::shared_ptr<Lent>*>(it); });
    out = pybind11::array(static_cast<pybind11::ssize_t>(n), typed.data(component), owner);
  });
  pybind11::detail::array_proxy(out.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

void LentArrays::close() {
  for (auto& [key, lent] : lent_) {
    if (lent.use_count() == 1) continue;
    with_type(*lent->field,
              [&, component = lent->component, length = lent->length, &kept = lent->kept](auto& field) {
                auto spare = std::make_unique<std::remove_reference_t<decltype(field)>>(
                    FieldInfo{.name = "kept", .dimension = field.info().dimension});
                field.fit(*spare);
                std::copy(field.data(component), field.data(component) + length, spare->data());
                field.swap(component, *spare);
                kept = std::move(spare);
              });
  }
  lent_.clear();
}

}  // namespace courant::native
