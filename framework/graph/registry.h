#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/schema.h"
#include "base/value.h"
#include "graph/pass.h"

namespace voxray {

/// A port of a pass, with the parameters' values that ask for it.
struct PortDoc : PortInfo {
    std::string with;  ///< Such as "first: rsm"; empty: the pass always has the port.
};

/// A kind of pass without its types, so that one function reads parameters of all kinds.
struct PassType {
    using Params = std::unique_ptr<void, void (*)(void*)>;
    const Schema* schema = nullptr;
    Params (*defaults)() = nullptr;
    std::unique_ptr<Pass> (*make)(const void* params) = nullptr;
};

/// A pass made from a config.
struct ConfiguredPass {
    std::unique_ptr<Pass> pass;
    Value parameters;                   ///< All of them, with defaults filled in.
    std::vector<UnusedSetting> unused;  ///< Parameters without effect because of others.
};

/// Keys of a graph entry that are not parameters of the pass.
const std::vector<std::string>& reservedKeys();

/// Description of one kind of pass.
struct PassKind {
    std::string name;
    std::string family;  ///< Folder under passes/; empty for a pass from elsewhere.
    std::string help;
    std::vector<ParameterDoc> parameters;
    std::vector<PortDoc> ports;  ///< All that it has with any values of its parameters.
    bool needsDevice = true;     ///< False: it runs where there is no Vulkan, too (Device::isHost()).
    /// What names of variants say where it follows the pass whose result it denoises, such as "filtered". Empty: for no
    /// such pass.
    std::string filterLabel;
    bool dependsOnLight = true;  ///< False: its outputs stay where lights alone change.
    PassType type;

    /// Makes a pass from its map in the config. @throws UsageError for an unknown or invalid parameter.
    ConfiguredPass create(const Value& map, const std::string& id) const;
};

/// Parameters of a pass that has none.
struct NoParams {
    static constexpr auto schema() { return std::tuple{}; }
};

/// All kinds of passes, filled by registerPasses (passes/common/families.h).
class Registry {
 public:
    /// P: see Pass. @throws Error for a name that another pass has.
    template <typename P>
    void add(const std::string& family = "") {
        PassKind kind;
        kind.name = P::kName;
        kind.family = family;
        kind.help = P::kHelp;
        if constexpr (requires { P::kNeedsDevice; }) kind.needsDevice = P::kNeedsDevice;
        if constexpr (requires { P::kDependsOnLight; }) kind.dependsOnLight = P::kDependsOnLight;
        if constexpr (requires { P::kFilterLabel; }) kind.filterLabel = P::kFilterLabel;
        if constexpr (requires { typename P::Params; })
            kind.type = typeOf<typename P::Params>(
                [](const void* p) { return make<P>(*static_cast<const typename P::Params*>(p)); });
        else
            kind.type = typeOf<NoParams>([](const void*) { return make<P>(); });
        add(std::move(kind));
    }

    /// An old name, and advice for errors: renamed("gather_all", "gather with 'light: all'").
    void renamed(std::string oldName, std::string advice);

    const std::vector<PassKind>& kinds() const { return kinds_; }
    const PassKind* find(const std::string& name) const;
    /// @throws UsageError at `where`: the advice for an old name, or "did you mean".
    const PassKind& require(const std::string& name, const TextLocation& where) const;

    /// Names of passes that write a port of this name without reading one of that name.
    std::vector<std::string> writersOf(const std::string& port) const;
    /// PassKind::filterLabel by name, of those that have one.
    std::map<std::string, std::string> filterLabels() const;

 private:
    template <typename Params>
    static PassType typeOf(std::unique_ptr<Pass> (*make)(const void*)) {
        return {&schemaOf<Params>(),
                [] { return PassType::Params(new Params, [](void* p) { delete static_cast<Params*>(p); }); }, make};
    }
    template <typename P, typename... Params>
    static std::unique_ptr<Pass> make(const Params&... params) {
        return std::make_unique<P>(params...);
    }
    /// Fills in parameters and ports.
    void add(PassKind kind);

    std::vector<PassKind> kinds_;
    std::map<std::string, std::string> renamed_;
};

/// Makes a pass known, at the end of its file: VOXRAY_REGISTER_PASS(Composite).
class PassRegistration {
 public:
    using Add = void (*)(Registry&, const std::string& family);
    PassRegistration(const char* file, Add add);
};
#define VOXRAY_REGISTER_PASS(P)                  \
    static const PassRegistration registered##P( \
        __FILE__, [](Registry& registry, const std::string& family) { registry.add<P>(family); })

/// Adds the passes that are registered in files of a folder, by their path. @param folder relative to the
/// source root, such as "passes/view/". @param family PassKind's. @return how many.
size_t addRegistered(Registry& registry, std::string_view folder, const std::string& family = "");

}  // namespace voxray
