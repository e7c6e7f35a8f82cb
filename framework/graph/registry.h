#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/schema.h"
#include "base/value.h"
#include "graph/pass.h"
#include "graph/preview.h"

namespace voxray {

/// A port that a pass has, and the values of parameters that it has it with, such as "first: rsm"; empty:
/// always.
struct PortDoc : PortInfo {
    std::string with;
};

/// A kind of pass without its types, so that one function reads parameters of all kinds.
struct PassType {
    using Params = std::unique_ptr<void, void (*)(void*)>;
    const Schema* schema;
    Params (*defaults)();
    std::unique_ptr<Pass> (*make)(const void* params);
};

/// What the registry knows of one kind of pass.
struct PassKind {
    std::string name;
    std::string help;
    std::vector<ParameterDoc> parameters;
    std::vector<PortDoc> ports;  ///< With any values of its parameters.
    bool needsDevice = true;     ///< False: it runs where there is no Vulkan, too (Device::isHost()).
    PassType type;

    /// Makes a pass from its map in the config. @param reserved keys that the graph itself reads.
    /// @throws UsageError for an unknown or invalid parameter.
    std::unique_ptr<Pass> create(const Value& map, const std::string& id,
                                 const std::vector<std::string>& reserved) const;
    /// The map with every default filled in, reserved keys left out.
    Value resolve(const Value& map, const std::string& id, const std::vector<std::string>& reserved) const;
    /// Parameters that the map names although they have no effect there.
    std::vector<IdleParameter> idle(const Value& map, const std::string& id,
                                    const std::vector<std::string>& reserved) const;
};

/// The ports that a pass has with each value of one parameter, in the order of its values.
struct PortsByValue {
    std::string parameter;
    std::vector<std::string> values;
    std::vector<std::vector<PortInfo>> ports;
};

/// All of a pass's ports: those of its defaults, then those that values of one parameter ask for.
std::vector<PortDoc> describePorts(const std::vector<PortInfo>& ofDefaults,
                                   const std::vector<PortsByValue>& ofChoices);

/// All kinds of passes, filled by registerPasses (passes/register_passes.h).
class Registry {
 public:
    /// P: see Pass.
    template <typename P>
    void add() {
        using Params = typename P::Params;
        bool needsDevice = true;
        if constexpr (requires { P::kNeedsDevice; }) needsDevice = P::kNeedsDevice;
        add(P::kName, P::kHelp, needsDevice,
            {&schemaOf<Params>(),
             [] { return PassType::Params(new Params, [](void* p) { delete static_cast<Params*>(p); }); },
             [](const void* p) { return std::unique_ptr<Pass>(new P(*static_cast<const Params*>(p))); }});
    }

    const std::vector<PassKind>& kinds() const { return kinds_; }
    const PassKind* find(const std::string& name) const;
    /// @throws UsageError with "did you mean" at `where`.
    const PassKind& require(const std::string& name, const TextLocation& where) const;

    /// Names of passes that write a port of this name out of others. Those that change what they read under
    /// it need a writer themselves.
    std::vector<std::string> writersOf(const std::string& port) const;

    /// Looks at a view before anything is rendered there. Empty where no pass brings one.
    Preview preview;

 private:
    void add(const char* name, const char* help, bool needsDevice, const PassType& type);

    std::vector<PassKind> kinds_;
};

}  // namespace voxray
