#pragma once

#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "graph/resource.h"

/// Ports: what a pass reads and writes, declared as its members.
namespace voxray {

struct PortInfo {
    std::string name;
    std::string help;
    bool output = false;
    bool optional = false;
    std::type_index type = typeid(void);
    Resource* (*create)() = nullptr;             ///< Makes the resource of an output.
    bool (*accepts)(const Resource&) = nullptr;  ///< Whether an input can read a resource.
};

/// Whether a resource is a T, or derived from it.
template <typename T>
bool isResource(const Resource& resource) {
    return dynamic_cast<const T*>(&resource) != nullptr;
}

class Port;

/// Owner of ports: a pass, passed on to the classes that several passes share.
class PortOwner {
 public:
    PortOwner() = default;
    PortOwner(const PortOwner&) = delete;
    PortOwner& operator=(const PortOwner&) = delete;
    /// In the order of its members.
    const std::vector<PortInfo>& ports() const { return ports_; }
    const std::string& nameOf(const Port& port) const;

 protected:
    ~PortOwner() = default;

 private:
    friend class Port;
    std::vector<PortInfo> ports_;
};

/// Base of inputs and outputs, which the graph binds to resources.
class Port {
 public:
    Port(const Port&) = delete;
    Port& operator=(const Port&) = delete;

 protected:
    Port(PortOwner& owner, PortInfo info, bool isPresent) {
        if (!isPresent) return;
        index_ = int(owner.ports_.size());
        owner.ports_.push_back(std::move(info));
    }

 private:
    friend class PortAccess;
    friend class PortOwner;
    int index_ = -1;  ///< In the owner's ports; -1: absent.
};

inline const std::string& PortOwner::nameOf(const Port& port) const {
    return ports_.at(size_t(port.index_)).name;
}

/// An input of a pass: what an earlier pass writes under this name (or that which the config's `inputs`
/// gives).
template <typename T>
class In : public Port {
 public:
    /// @param isPresent false if the pass has no such port with its parameters.
    In(PortOwner& owner, std::string name, std::string help, bool isPresent = true)
        : Port(owner, {std::move(name), std::move(help), false, false, typeid(T), nullptr, isResource<T>}, isPresent) {}
};

/// An input without which the graph is valid, too.
template <typename T>
class InOptional : public Port {
 public:
    InOptional(PortOwner& owner, std::string name, std::string help, bool isPresent = true)
        : Port(owner, {std::move(name), std::move(help), false, true, typeid(T), nullptr, isResource<T>}, isPresent) {}
};

/// An output of a pass.
template <typename T>
class Out : public Port {
 public:
    Out(PortOwner& owner, std::string name, std::string help, bool isPresent = true)
        : Port(owner, {std::move(name), std::move(help), true, false, typeid(T), []() -> Resource* { return new T(); }},
               isPresent) {}
};

/// Access to the resources that a pass's ports are bound to.
class PortAccess {
 public:
    /// @param resources in the order of the owner's ports; null where an optional input has none.
    PortAccess(const PortOwner& owner, const std::vector<Resource*>& resources)
        : owner_(owner), resources_(resources) {}

    /// @throws Error for a port that the pass doesn't have with its parameters.
    template <typename T>
    const T& operator[](const In<T>& port) const {
        return static_cast<const T&>(required(port));
    }
    /// Null where nothing writes it.
    template <typename T>
    const T* operator[](const InOptional<T>& port) const {
        return static_cast<const T*>(bound(port));
    }
    template <typename T>
    T& operator[](const Out<T>& port) const {
        return static_cast<T&>(required(port));
    }

 protected:
    Resource* bound(const Port& port) const { return port.index_ < 0 ? nullptr : resources_[size_t(port.index_)]; }
    Resource& required(const Port& port) const;

    const PortOwner& owner_;
    const std::vector<Resource*>& resources_;
};

}  // namespace voxray
