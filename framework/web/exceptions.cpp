// Exceptions for the programs of the page to work in. The C++ library that comes with its compiler was built without
// them: what follows is the part of the Itanium C++ ABI that a compiler asks for with -fwasm-exceptions, where a throw
// is an instruction and the engine finds the handlers by itself.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <typeinfo>

// Names that the ABI gives.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
struct _Unwind_Exception;

namespace __cxxabiv1 {

/// How the C++ library sees each type: only the order of its virtual functions counts here.
class __shim_type_info : public std::type_info {
public:
    ~__shim_type_info() override;
    virtual void noop1() const;
    virtual void noop2() const;
    /// Whether a handler for this type takes a `thrown` object, which is then moved to the base that it asks for.
    virtual bool can_catch(const __shim_type_info* thrown, void*& object) const = 0;
};

}  // namespace __cxxabiv1

namespace {

using Type = __cxxabiv1::__shim_type_info;
using Destroy = void* (*)(void*);  // a destructor returns its object here

/// In front of each object that is thrown. One that is thrown again from an exception_ptr has a header only, whose
/// object is that of the first.
struct Header {
    void* object;
    const std::type_info* type;
    Destroy destroy;
    std::size_t references;               ///< those of exception_ptr, and one for being thrown
    int handlers;                         ///< that hold it now; negative while one of them throws it again
    Header* next;                         ///< what was caught before it and is not done with
    void* adjusted;                       ///< the object as its handler sees it
    alignas(16) std::uint64_t thrown[2];  ///< the address of this is what travels
};

Header* last_caught = nullptr;
unsigned in_flight = 0;

Header* header_of(void* thrown) {
    return reinterpret_cast<Header*>(static_cast<char*>(thrown) - offsetof(Header, thrown));
}

Header* primary_of(void* object) { return static_cast<Header*>(object) - 1; }

Header* new_header(std::size_t size) {
    void* const memory = std::calloc(1, sizeof(Header) + size);
    if (memory == nullptr) {
        std::terminate();
    }
    return static_cast<Header*>(memory);
}

[[noreturn]] void raise(Header* header) {
    ++in_flight;
    __builtin_wasm_throw(0, header->thrown);
}

/// What a landing pad asks about, and the answer: which of its handlers takes the exception, 0 for none.
struct LandingPad {
    std::uintptr_t index;
    const std::uint8_t* table;
    std::uintptr_t selector;
};

std::uintptr_t read_uleb(const std::uint8_t*& at) {
    std::uintptr_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
        const std::uint8_t byte = *at++;
        value |= static_cast<std::uintptr_t>(byte & 0x7FU) << shift;
        if ((byte & 0x80U) == 0) {
            return value;
        }
    }
}

std::intptr_t read_sleb(const std::uint8_t*& at) {
    std::uint64_t value = 0;
    unsigned shift = 0;
    std::uint8_t byte = 0;
    do {
        byte = *at++;
        value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
        shift += 7;
    } while ((byte & 0x80U) != 0);
    return static_cast<std::intptr_t>((byte & 0x40U) != 0 ? value | (~std::uint64_t{0} << shift) : value);
}

/// The parts of a function's table that landing pads need: for each pad the first of its actions, actions one after
/// the other, and types, counted backwards.
struct Table {
    const std::uint8_t* types = nullptr;
    const std::uint8_t* pads = nullptr;
    const std::uint8_t* actions = nullptr;

    explicit Table(const std::uint8_t* at) {
        ++at;  // the encoding of a start that is always left out
        constexpr std::uint8_t k_no_types = 0xFF;
        if (*at++ != k_no_types) {
            const std::uintptr_t offset = read_uleb(at);
            types = at + offset;
        }
        ++at;  // the encoding of what follows
        const std::uintptr_t length = read_uleb(at);
        pads = at;
        actions = at + length;
    }

    [[nodiscard]] const Type* type(std::intptr_t index) const {
        const Type* found = nullptr;
        std::memcpy(static_cast<void*>(&found), types - index * static_cast<std::intptr_t>(sizeof found), sizeof found);
        return found;
    }

    /// Counted from 1; 0 for a pad that only cleans up.
    [[nodiscard]] std::uintptr_t first_action(std::uintptr_t pad) const {
        const std::uint8_t* at = pads;
        for (std::uintptr_t i = 0;; ++i) {
            read_uleb(at);
            const std::uintptr_t action = read_uleb(at);
            if (i == pad) {
                return action;
            }
        }
    }
};

std::uintptr_t selected(const Table& table, std::uintptr_t pad, Header& header) {
    const std::uintptr_t first = table.first_action(pad);
    if (first == 0) {
        return 0;
    }
    const std::uint8_t* action = table.actions + (first - 1);
    while (true) {
        const std::intptr_t index = read_sleb(action);
        const std::uint8_t* const next = action;
        if (index > 0) {
            const Type* const wanted = table.type(index);  // none: a handler for everything
            void* object = header.object;
            if (wanted == nullptr || wanted->can_catch(static_cast<const Type*>(header.type), object)) {
                header.adjusted = object;
                return static_cast<std::uintptr_t>(index);
            }
        }
        const std::intptr_t offset = read_sleb(action);
        if (offset == 0) {
            return 0;
        }
        action = next + offset;
    }
}

}  // namespace

asm(".globl __cpp_exception\n"
    ".tagtype __cpp_exception i32\n"
    "__cpp_exception:\n");

extern "C" {

LandingPad __wasm_lpad_context;

int _Unwind_CallPersonality(void* thrown) {
    LandingPad& pad = __wasm_lpad_context;
    pad.selector = pad.table == nullptr ? 0 : selected(Table(pad.table), pad.index, *header_of(thrown));
    return 0;
}

void* __cxa_allocate_exception(std::size_t size) noexcept {
    Header* const header = new_header(size);
    header->object = header + 1;
    return header->object;
}

void __cxa_free_exception(void* object) noexcept { std::free(primary_of(object)); }

void __cxa_increment_exception_refcount(void* object) noexcept {
    if (object != nullptr) {
        ++primary_of(object)->references;
    }
}

void __cxa_decrement_exception_refcount(void* object) noexcept {
    if (object == nullptr || --primary_of(object)->references > 0) {
        return;
    }
    Header* const header = primary_of(object);
    if (header->destroy != nullptr) {
        header->destroy(object);
    }
    std::free(header);
}

[[noreturn]] void __cxa_throw(void* object, const std::type_info* type, Destroy destroy) {
    Header* const header = primary_of(object);
    header->type = type;
    header->destroy = destroy;
    header->references = 1;
    raise(header);
}

[[noreturn]] void __cxa_rethrow() {
    if (last_caught == nullptr) {
        std::terminate();
    }
    last_caught->handlers = -last_caught->handlers;
    raise(last_caught);
}

void* __cxa_get_exception_ptr(void* thrown) noexcept { return header_of(thrown)->adjusted; }

void* __cxa_begin_catch(void* thrown) noexcept {
    Header* const header = header_of(thrown);
    header->handlers = (header->handlers < 0 ? -header->handlers : header->handlers) + 1;
    if (last_caught != header) {
        header->next = last_caught;
        last_caught = header;
    }
    --in_flight;
    return header->adjusted;
}

void __cxa_end_catch() {
    Header* const header = last_caught;
    if (header == nullptr) {
        return;
    }
    if (header->handlers < 0) {
        if (++header->handlers == 0) {
            last_caught = header->next;
        }
        return;
    }
    if (--header->handlers > 0) {
        return;
    }
    last_caught = header->next;
    void* const object = header->object;
    if (header != primary_of(object)) {
        std::free(header);
    }
    __cxa_decrement_exception_refcount(object);
}

void* __cxa_current_primary_exception() noexcept {
    void* const object = last_caught == nullptr ? nullptr : last_caught->object;
    __cxa_increment_exception_refcount(object);
    return object;
}

void __cxa_rethrow_primary_exception(void* object) {
    if (object == nullptr) {
        return;
    }
    Header* const header = new_header(0);
    header->object = object;
    header->type = primary_of(object)->type;
    __cxa_increment_exception_refcount(object);
    raise(header);
}

bool __cxa_uncaught_exception() noexcept { return in_flight != 0; }

unsigned __cxa_uncaught_exceptions() noexcept { return in_flight; }

/// There is one thread, which ends with the program.
int __cxa_thread_atexit(Destroy /*destroy*/, void* /*object*/, void* /*library*/) { return 0; }

}  // extern "C"

namespace __cxxabiv1 {

std::uint64_t __getExceptionClass(const _Unwind_Exception* /*exception*/) { return 0; }
void __setExceptionClass(_Unwind_Exception* /*exception*/, std::uint64_t /*name*/) {}
bool __isOurExceptionClass(const _Unwind_Exception* /*exception*/) { return true; }

}  // namespace __cxxabiv1
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
