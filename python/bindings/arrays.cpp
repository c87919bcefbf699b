// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/arrays.hpp"

namespace nb = nanobind;

namespace strake::python {

Array<bool> array_of_bits(const std::vector<bool>& bits) {
  // A vector<bool> has no bytes to show.
  const auto owner = std::make_shared<std::vector<std::uint8_t>>(bits.begin(), bits.end());
  return Array<bool>(owner->data(), {bits.size()}, keep_alive(owner));
}

nb::object bytes_of(const void* data, std::size_t size, const nb::object& owner) {
  // An array of nothing must point somewhere.
  constexpr std::uint8_t kNothing = 0;
  const void* const from = size == 0 ? &kNothing : data;
  return nb::cast(nb::ndarray<nb::numpy, const std::uint8_t, nb::ndim<1>>(from, {size}, owner));
}

nb::object records_of(const void* data, std::size_t count, std::size_t size,
                      const std::vector<Field>& fields, const nb::object& owner) {
  nb::list names, formats, offsets;
  for (const Field& field : fields) {
    names.append(field.name);
    formats.append(field.format);
    offsets.append(field.offset);
  }
  nb::dict layout;
  layout["names"] = names;
  layout["formats"] = formats;
  layout["offsets"] = offsets;
  layout["itemsize"] = size;
  const nb::object type = nb::module_::import_("numpy").attr("dtype")(layout);
  return bytes_of(data, count * size, owner).attr("view")(type);
}

}  // namespace strake::python
