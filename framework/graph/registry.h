#pragma once

#include <functional>
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

/// What the registry knows of one kind of pass.
struct PassKind {
    std::string name;
    std::string help;
    std::vector<ParameterDoc> parameters;
    std::vector<PortDoc> ports;  ///< With any values of its parameters.
    bool needsDevice = true;     ///< False: it runs where there is no Vulkan, too (Device::isHost()).
    /// Makes a pass from its map in the config. @param reserved keys that the graph itself reads.
    /// @throws UsageError for an unknown or invalid parameter.
    std::function<std::unique_ptr<Pass>(const Value& map, const std::string& id,
                                        const std::vector<std::string>& reserved)>
        create;
    /// The map with every default filled in, reserved keys left out.
    std::function<Value(const Value& map, const std::string& id, const std::vector<std::string>& reserved)>
        resolve;
    /// Parameters that the map names although they have no effect there.
    std::function<std::vector<IdleParameter>(const Value& map, const std::string& id,
                                             const std::vector<std::string>& reserved)>
        idle;
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
        PassKind kind;
        kind.name = P::kName;
        kind.help = P::kHelp;
        kind.parameters = describeParams<typename P::Params>();
        kind.ports = portsOf<P>();
        if constexpr (requires { P::kNeedsDevice; }) kind.needsDevice = P::kNeedsDevice;
        kind.create = [](const Value& map, const std::string& id, const std::vector<std::string>& reserved) {
            return std::unique_ptr<Pass>(new P(readParams<typename P::Params>(map, id, reserved)));
        };
        kind.resolve = [](const Value& map, const std::string& id, const std::vector<std::string>& reserved) {
            return writeParams(readParams<typename P::Params>(map, id, reserved));
        };
        kind.idle = [](const Value& map, const std::string& id, const std::vector<std::string>& reserved) {
            return idleParams(readParams<typename P::Params>(map, id, reserved), map);
        };
        kinds_.push_back(std::move(kind));
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
    template <typename P>
    static std::vector<PortInfo> declared(const typename P::Params& params) {
        PassBuilder builder;
        P(params).declare(builder);
        return builder.ports();
    }

    template <typename P>
    static std::vector<PortDoc> portsOf() {
        using Params = typename P::Params;
        std::vector<PortsByValue> choices;
        for (const Parameter& parameter : schemaOf<Params>()) {
            PortsByValue choice{parameter.name, parameter.type->choices(), {}};
            if (std::string_view(parameter.type->name()) != "choice") continue;
            for (const std::string& value : choice.values) {
                Params params;
                parameter.type->read(parameter.of(&params), Value::fromScalar(value), parameter.name);
                choice.ports.push_back(declared<P>(params));
            }
            choices.push_back(std::move(choice));
        }
        return describePorts(declared<P>(Params{}), choices);
    }

    std::vector<PassKind> kinds_;
};

}  // namespace voxray
