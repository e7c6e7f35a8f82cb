#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/schema.h"
#include "base/value.h"
#include "graph/pass.h"

namespace voxray {

/// What the registry knows of one kind of pass.
struct PassKind {
    std::string name;
    std::string help;
    std::vector<ParameterDoc> parameters;
    std::vector<PortInfo> ports;
    /// Makes a pass from its map in the config. @param reserved keys that the graph itself reads.
    /// @throws UsageError for an unknown or invalid parameter.
    std::function<std::unique_ptr<Pass>(const Value& map, const std::string& id,
                                        const std::vector<std::string>& reserved)>
        create;
    /// The map with every default filled in, reserved keys left out.
    std::function<Value(const Value& map, const std::string& id, const std::vector<std::string>& reserved)>
        resolve;
};

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
        PassBuilder builder;
        P(typename P::Params{}).declare(builder);
        kind.ports = builder.ports();
        kind.create = [](const Value& map, const std::string& id, const std::vector<std::string>& reserved) {
            return std::unique_ptr<Pass>(new P(readParams<typename P::Params>(map, id, reserved)));
        };
        kind.resolve = [](const Value& map, const std::string& id, const std::vector<std::string>& reserved) {
            return writeParams(readParams<typename P::Params>(map, id, reserved));
        };
        kinds_.push_back(std::move(kind));
    }

    const std::vector<PassKind>& kinds() const { return kinds_; }
    const PassKind* find(const std::string& name) const;
    /// @throws UsageError with "did you mean" at `where`.
    const PassKind& require(const std::string& name, const TextLocation& where) const;

 private:
    std::vector<PassKind> kinds_;
};

}  // namespace voxray
