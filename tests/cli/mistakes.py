"""A config without a mistake, and mistakes that newcomers make in it."""

CONFIG = """\
name: mine
scene:
  builtin: cornell
  camera: {position: [0, 1, 3], target: [0, 1, 0], fov_deg: 50}
  lights:
    - {point: [0, 1.8, 0], intensity: [1, 1, 1]}
image: {width: 32, height: 24}
seed: 7
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 16}
  - {pass: inject_light_rays, id: inject, rays_per_light: 4096, bounces: 2}
  - {pass: trace_gather_rays}
  - {pass: gather_rays, id: gather}
  - {pass: filter_irradiance, id: indirect, inputs: {noisy_irradiance: gather}}
  - {pass: direct_shadow_rays, id: direct}
  - {pass: composite}
reference: {pass: path_trace, spp: 8, bounces: 3}
sweep:
  inject.rays_per_light: [4096, 8192]
measure: {frames: 2, masks: {floor: {material: grey}}}
profiles:
  smaller: {image: {width: 16}}
"""
CAMERA = "camera: {position: [0, 1, 3], target: [0, 1, 0], fov_deg: 50}"
VOXELIZE = "  - {pass: voxelize, resolution: 16}"
GRAPH = CONFIG[CONFIG.index("graph:"):CONFIG.index("reference:")]
SWEEP = CONFIG[CONFIG.index("sweep:"):CONFIG.index("measure:")]
REFERENCE_TO_MASKS = CONFIG[CONFIG.index("reference:"):CONFIG.index("profiles:")].rstrip()
INPUT_TO_SWEEP = CONFIG[CONFIG.index("{noisy_irradiance"):CONFIG.index("measure:")]
VIEW_TO_MASKS = CONFIG[CONFIG.index("fov_deg"):CONFIG.index("profiles:")]
NARROW_VIEW = VIEW_TO_MASKS.replace("fov_deg: 50", "fov_deg: 20")
INTENSITY = "intensity: [1, 1, 1]"
LAMP = "lights:\n    - {point: [0, 1.8, 0], intensity: [1, 1, 1]}"
GATHER, LAST = "  - {pass: gather_rays, id: gather}", "  - {pass: composite}"
FILTER = "  - {pass: filter_irradiance, id: indirect, inputs: {noisy_irradiance: gather}}"
PATHS = "{pass: path_trace, spp: 8, bounces: 3}"
VALUES = "inject.rays_per_light: [4096, 8192]"
PROFILE = "{image: {width: 16}}"

# What is written in place of what; the line that the message names; what the message has besides: a name, or words that say
# what is wrong or what to write.
MISTAKES = {
    "a pass is misspelt": ("pass: voxelize", "pass: voxelise", 11, "'voxelize'"),
    "the key 'pass' is misspelt": ("pass: gbuffer", "pas: gbuffer", 10, "'pass'"),
    "a parameter is misspelt": ("bounces: 2", "bounce: 2", 12, "'bounces'"),
    "a parameter of another pass": ("{pass: gbuffer}", "{pass: gbuffer, resolution: 64}", 10, "'voxelize'"),
    "a parameter of the pass before": ("pass: gather_rays,", "pass: gather_rays, rays_per_block: 64,", 14,
        "unknown parameter 'rays_per_block', which 'trace_gather_rays' has"),
    "a leading zero": ("resolution: 16", "resolution: 032", 11, "voxelize.resolution: '032' begins with a zero: write 32"),
    "a blank in an id": ("id: gather}", "id: my filter}", 14, "'my filter'"),
    "an image that is written over": (LAST, "  - {pass: composite}\n  - {pass: path_trace, bounces: 3}", 17,
        "'composite' is never run: 'path_trace', after it, writes 'final' too"),
    "an image that is written over, without a sweep": (
        f"{LAST}\nreference: {PATHS}\n{SWEEP}", f"{LAST}\n  - {{pass: path_trace, bounces: 3}}\nreference: {PATHS}\n",
        17, "'composite'"),
    "a word for a number": ("resolution: 16", "resolution: high", 11, "'high'"),
    "a fraction for a whole number": ("resolution: 16", "resolution: 16.5", 11, "'16.5'"),
    "a list where the sweep belongs": ("resolution: 16", "resolution: [16, 32]", 11, "expected a whole number, not a list"),
    "a number in quotes": ("seed: 7", 'seed: "7"', 8, "stands in quotes"),
    "a negative size": ("width: 32", "width: -32", 7, "-32 is out of range [1, 8192]"),
    "an unknown key": ("seed: 7", "seeds: 7", 8, "'seed'"),
    "a name that is no folder": ("name: mine", "name: my/run", 1, "my/run"),
    "an unknown built-in scene": ("builtin: cornell", "builtin: cornel", 3, "'cornell'"),
    "a missing scene file": ("builtin: cornell", "file: nowhere.glb", 3, "'nowhere.glb'"),
    "a missing environment map": ("  lights:", "  environment: sky.exr\n  lights:", 5, "'sky.exr'"),
    "an unknown camera": (CAMERA, "camera: front", 4, "'front'"),
    "a camera without a target": ("target: [0, 1, 0], ", "", 4, "'target'"),
    "a camera that looks along up": ("target: [0, 1, 0]", "target: [0, 2, 3]", 4, "'up'"),
    "a decimal comma": ("1.8", "1,8", 6, "point: expected three numbers, as in [1, 1, 1]"),
    "a light's power": (INTENSITY, "power: 60", 6,
        "unknown parameter 'power'; how bright it is: write intensity: [r, g, b], in W/sr"),
    "a light's colour": ("{point: [0, 1.8, 0], intensity", "{directional: [0, -1, 0], color", 6,
        "write irradiance: [r, g, b], in W/m²"),
    "a spotlight's target": ("{point: [0, 1.8, 0],", "{spot: [0, 1.8, 0], target: [0, 0, 0],", 6,
        "write direction: [x, y, z], the target less the light's place"),
    "no lights by a word": (LAMP, "lights: none", 5, "write 'keep_file_lights: false'"),
    "an unknown kind of light": ("{point: [", "{pont: [", 6, "'point'"),
    "the unit of another light": ("intensity: [", "irradiance: [", 6, "'irradiance'"),
    "a light darker than black": (INTENSITY, "intensity: -1", 6, "-1 is out of range"),
    "a light that is no list": ("    - {point", "    {point", 5, "expected a list of lights, as in [{point: "),
    "lights by a word": (LAMP, "lights: pointy", 5, "'point'"),
    "voxels between light and its reader": (
        GATHER, "  - {pass: voxelize, id: finer, resolution: 32}\n  - {pass: gather_rays, id: gather}",
        15, "write 'inputs: {voxels: voxelize}' here"),
    "the same id twice": ("id: gather}", "id: inject}", 14, "'inject'"),
    "an input from a pass that isn't there": ("noisy_irradiance: gather", "noisy_irradiance: gathr", 15, "'gather'"),
    "an input, misspelt, of a pass that a sweep replaces": (
        INPUT_TO_SWEEP, INPUT_TO_SWEEP.replace("gather", "gathr", 1).replace(VALUES, "indirect: [filter_irradiance]"),
        15, "indirect.inputs.noisy_irradiance: no pass has the id 'gathr' in any variant; did you mean 'gather'?"),
    "an input that the pass lacks": ("{noisy_irradiance: gather}", "{noisy: gather}", 15, "'noisy_irradiance'"),
    "an input of another type": ("noisy_irradiance: gather", "noisy_irradiance: inject", 15, "'noisy_irradiance'"),
    "a pass is missing": ("  - {pass: gbuffer}\n", "", 12,
        "missing port 'gbuffer' (what the camera sees); no pass before it writes it; these can: gbuffer"),
    "passes in the wrong order": ("  - {pass: trace_gather_rays}\n  - {pass: gather_rays, id: gather}\n",
        "  - {pass: gather_rays, id: gather}\n  - {pass: trace_gather_rays}\n", 13, "move 'trace_gather_rays' up"),
    "nothing writes the image": ("  - {pass: composite}\n", "", 9,
        "no pass writes 'final', the image that is compared; these can: composite, glsl, show_voxels, path_trace"),
    "a reference that is no path tracer": ("pass: path_trace, spp: 8, bounces: 3", "pass: gbuffer", 18,
        "'gbuffer' renders no reference"),
    "a reference by a gather": ("pass: path_trace, spp: 8, bounces: 3", "pass: gather_rays", 18,
        "reference: 'gather_rays' renders no reference: it writes no 'sums'; use path_trace"),
    "a reference of one sample": ("spp: 8", "spp: 1", 18, "must be at least 2"),
    "a sweep of a pass that isn't there": ("inject.rays", "injekt.rays", 20, "'inject'"),
    "a sweep of a parameter that isn't there": ("inject.rays_per_light", "inject.rays", 20, "'rays_per_light'"),
    "a sweep of one value": ("[4096, 8192]", "4096", 20, "expected a list of values, as in [64, 128]"),
    "a sweep out of range": ("[4096, 8192]", "[4096, 0]", 20, "0 is out of range"),
    "a mask of an unknown material": ("material: grey", "material: gray", 21, "'grey'"),
    "an unknown measure": ("frames: 2", "frame: 2", 21, "'frames'"),
    "a profile of an unknown key": ("smaller: {image:", "smaller: {imgae:", 23, "'image'"),
    "an image by one word": ("image: {width: 32, height: 24}", "image: 32x24", 7, "{width: 640, height: 360}"),
    "a radiance of two numbers": ("  lights:", "  environment: [1, 2]\n  lights:", 5, "expected three numbers"),
    "a camera that sees nothing": ("target: [0, 1, 0]", "target: [0, 1, 9]", 4, "no surface lies in its view"),
    "a parameter without effect": ("resolution: 16", "resolution: 16, samples_per_voxel_edge: 4", 11,
        "no effect with method: exact; only with method: three_axis"),
    "a sweep without effect": (VALUES, "gather.light_samples: [1, 2]\n  gather.near_field_cells: [0]", 20, "direct_at_hits: shadow_rays"),
    "a key twice": ("seed: 7", "seed: 7\nseed: 8", 9, "'seed'"),
    "a line is indented too far": ("seed: 7", "  seed: 7", 8, "'seed'"),
    "a parameter below its pass's name": (VOXELIZE, "  - pass: voxelize\n      resolution: 16", 12,
        "'resolution' is indented unlike 'pass' in line 11, which has its value: indent it as far, by 4"),
    "a parameter below its pass's dash": (VOXELIZE, "  - pass: voxelize\n  resolution: 16", 12,
        "'resolution' is indented unlike what the dash in line 11 begins with: indent it by 4 spaces"),
    "a merge key without a map": (VOXELIZE, "  - {pass: voxelize, <<: 16}", 11, "<<"),
    "a wrong value that is merged in": (VOXELIZE, "  - {pass: voxelize, <<: {resolution: high}}", 11, "'high'"),
    "a lost dash": (LAST, "  {pass: composite}", 17, "indented"),
    "a tab": (LAST, "\t- {pass: composite}", 17, "spaces"),
    "no space after a dash": (LAST, "  -{pass: composite}", 17, "dash"),
    "no space before a comment": ("seed: 7", "seed: 7#the first", 8, "not '7#the first'; a space is missing before '#'"),
    "an empty file": (CONFIG, "", 1, "docs/writing-a-config.md"),
    "a block that stands as far in as the passes": ("\nreference:", "\n  reference:", 18, "'reference'"),
    "a list of keys": (CONFIG, "- name: mine\n- scene: cornell\n", 1, "dashes"),
    "a lost brace": ("height: 24}", "height: 24", 7,
        "the '{' in this line is not closed: a '}' is missing, or a comma before line 8"),
    "a pass's lost brace": ("{pass: gbuffer}", "{pass: gbuffer", 10, "'{'"),
    "a lost colon": ("seed: 7", "seed 7", 9, "':'"),
    # Units and types
    "a unit next to a number": ("width: 32", "width: 32px", 7, "'32px'"),
    "radians for degrees": ("fov_deg: 50", "fov_deg: 0.87", 4, "0.87 is out of range [1, 179]"),
    "commas in a number": ("rays_per_light: 4096", "rays_per_light: 4,096", 12, "write numbers without commas"),
    "one number for a place": ("position: [0, 1, 3]", "position: 3", 4, "expected three numbers, as in [0, 1, 0], not '3'"),
    "a place by the names of its axes": ("point: [0, 1.8, 0]", "point: {x: 0, y: 1.8, z: 0}", 6, "expected three numbers"),
    "one number for a way": ("  lights:", "  add: [{builtin: mirror_row, transform: {translate: 1}}]\n  lights:", 5,
        "expected three numbers, as in [0, 1, 0], not '1'"),
    "a colour in bytes": ("  lights:", "  override: {grey: {base_color: [255, 128, 0]}}\n  lights:", 5,
        "255 is out of range [0, 1]"),
    "a number for a switch": ("frames: 2", "frames: 2, second_seed: 1", 21, "'1'"),
    "a light of two kinds": ("point: [0, 1.8, 0]", "point: [0, 1.8, 0], directional: [0, -1, 0]", 6, "directional, point and spot"),
    "a cone inside out": ("{point: [0, 1.8, 0]", "{spot: [0, 1.8, 0], inner_deg: 60", 6, "inner_deg must be less than outer_deg"),
    "a seed below 0": ("seed: 7", "seed: -1", 8, "-1 is out of range"),
    "a number with an exponent": ("rays_per_light: 4096", "rays_per_light: 1e6", 12, "not '1e6': write 1000000"),
    "a number with underscores": ("rays_per_light: 4096", "rays_per_light: 1_000_000", 12, "1000000"),
    "a seed of more than 63 bits": ("seed: 7", "seed: 9223372036854775808", 8, "9223372036854775808 is out of range"),
    "an infinite light": (INTENSITY, "intensity: .inf", 6, "'.inf'"),
    "a metric in capitals": ("frames: 2", "frames: 2, metrics: [SSIM]", 21, "'ssim'"),
    "metrics by one word": ("frames: 2", "frames: 2, metrics: all", 21, "expected a list, as in [flip, relmse]"),
    "a sequence too short for its frames": ("frames: 2", "frames: 2, compare_every: 1", 21, "'frames'"),
    "an environment by a color's name": ("  lights:", "  environment: white\n  lights:", 5,
        "expected none, a radiance as in 0.5 or [1, 1, 1], or a map as in sky.exr"),
    "an environment by its color": ("  lights:", "  environment: {color: [1, 1, 2]}\n  lights:", 5,
        "write environment: [1, 1, 2]"),
    "a light of a surface": ("{point: [0, 1.8, 0], ", "{area: [0, 1.8, 0], ", 6,
        "to let a surface shine, write override: {MATERIAL: {emission: 5}}"),
    "a rotation without its unit": ("  lights:",
        "  add: [{builtin: mirror_row, transform: {rotate: [0, 9, 0]}}]\n  lights:", 5, "'rotate_deg'"),
    "one scene to add, not a list": ("  lights:", "  add: {builtin: mirror_row}\n  lights:", 5,
        "expected a list of scenes, as in [{file: dragon.glb}]"),
    # YAML
    "a quote left open": ("name: mine", 'name: "mine', 1, "quote"),
    "no space after a colon": ("width: 32", "width:32", 7, "':'"),
    # Paths of files
    "a file's name with a typo": ("builtin: cornell", "file: mime.yaml", 3, "'mine.yaml'"),
    "a file below the home folder": ("builtin: cornell", "file: ~/room.glb", 3, "~/room.glb"),
    "a scene file that holds no scene": ("builtin: cornell", "file: mine.yaml", 3, "glTF"),
    "a folder for a scene file": ("builtin: cornell", "file: .", 3, "is a folder, not a file"),
    "an environment that is no image": ("  lights:", "  environment: mine.yaml\n  lights:", 5, "OpenImageIO"),
    "a file by a variable": ("builtin: cornell", "file: $HOME/room.glb", 3,
        "'$' stands for no variable here: write the whole path"),
    "a file and a built-in scene": ("builtin: cornell", "builtin: cornell\n  file: mine.yaml", 4, "'builtin'"),
    "a sweep of files above a built-in scene": (VALUES, "scene.file: [a.glb, b.glb]", 20, "'builtin'"),
    "a path of Windows in quotes": ("builtin: cornell", 'file: "C:\\scenes\\room.glb"', 3, "'/'"),
    # References
    "a reference by its pass alone": (PATHS, "path_trace", 18, "{pass: path_trace"),
    "a reference by its picture": (PATHS, "{file: ref.exr}", 18, "./voxray compare final.exr ref.exr"),
    "a reference of indirect light": ("bounces: 3}", "bounces: 3, light: indirect}", 18, "'all'"),
    "samples by another renderer's word": ("spp: 8", "samples: 8", 18, "unknown parameter 'samples'; one of: spp, "),
    "samples by a word": ("spp: 8", "spp: many", 18, "expected a whole number, not 'many'"),
    # Sweeps
    "numbers of one place as a sweep": (VALUES, "scene.camera.position: [0, 1, 3]", 20, "'0'"),
    "a sweep written as nested maps": (VALUES, "inject: {rays_per_light: [4096, 8192]}", 20,
        "write inject.rays_per_light: [4096, 8192]"),
    "a nested sweep of words": (VALUES, "voxelize:\n    method: [exact, three_axis]", 21,
        "write voxelize.method: [exact, three_axis]"),
    "a sweep by the pass, which has an id": ("inject.rays_per", "inject_light_rays.rays_per", 20,
        "did you mean 'inject', the id"),
    "an underscore for the dot": ("inject.rays_per", "inject_rays_per", 20, "'inject.rays_per_light'"),
    "a sweep of how it is measured": (VALUES, "measure.frames: [1, 2]", 20, "'measure.frames' is the same for all variants"),
    "a sweep of one light's intensity": (VALUES, "scene.lights.intensity: [1, 2]", 20,
        "write a list of lists, as in scene.lights: [[...], [...]]"),
    "a value twice in a sweep": ("[4096, 8192]", "[4096, 4096]", 20, "a value appears twice"),
    "a swap that leaves an input without writer": (VALUES, "gather: [gather_rays, gather_irradiance]", 15,
        "'noisy_irradiance'"),
    # Profiles, whichever is asked for
    "a profile of an unknown parameter": (PROFILE, "{voxelize.resolutoin: 8}", 23, "'resolution'"),
    "a profile out of range": (PROFILE, "{reference.spp: 1}", 23, "must be at least 2"),
    "a profile of a sweep that isn't there": (PROFILE, "{sweep.voxelise.resolution: [8]}", 23, "'voxelize'"),
    "a profile as --set has it": (PROFILE, "[image.width=16]", 23, "expected a map of overrides, as in {image.width: 160}"),
    "a profile that takes the scene out": (PROFILE, "{scene: null}", 23, "'scene'"),
    # Order
    "direct light after the sum": (
        "  - {pass: direct_shadow_rays, id: direct}\n  - {pass: composite}",
        "  - {pass: composite}\n  - {pass: direct_shadow_rays, id: direct}",
        17, "put 'direct' right before 'composite'"),
    "a filter before what it filters": (
        f"{GATHER}\n{FILTER}", f"{FILTER}\n{GATHER}", 14, "'indirect'"),
    # Words out of their place
    "a sweep of a parameter without its pass": ("inject.rays_per_light", "rays_per_light", 20, "'inject.rays_per_light'"),
    "a sweep of a key without its block": (VALUES, "camera.fov_deg: [40, 60]", 20, "'scene.camera'"),
    "a key of another block": ("seed: 7", "frames: 3", 8, "unknown key 'frames'; it stands in 'measure'"),
    "the beginning of a word": ("position: [0, 1, 3]", "pos: [0, 1, 3]", 4, "'position'"),
    "a built-in scene's parameter, cut short": ("builtin: cornell", "builtin: cornell\n  box: false", 4, "'boxes'"),
    "a sweep that adds a pass": (VALUES, "inject_rsm: [inject_rsm, inject_light_rays]", 20, "'inject_rsm'"),
    "values of a parameter for passes": (VALUES, "inject: [4096, 8192]", 20,
        "'4096' is no pass: to vary a parameter of 'inject', write inject.PARAMETER: [4096, 8192]"),
    "a light by its type": ("{point: [0, 1.8, 0], ", "{type: point, position: [0, 1.8, 0], ", 6, "{point: "),
    # Signs
    "an equals sign": ("{width: 32, height: 24}", "{width = 32, height = 24}", 7, "'='"),
    "a typographic minus": ("1.8", "\u22121.8", 6, "'-'"),
    "a non-breaking space": ("  builtin: cornell", "\u00a0\u00a0builtin: cornell", 3, "non-breaking space"),
    "a colon in a text": ("name: mine", "name: mine: two", 1, "quotes"),
    "a colon in a variant's name": (VALUES, "gather:\n    rays: 4 a pixel: [gather_rays]", 21,
        'put a text that holds one between quotes, as in "rays: 4 a pixel": ...'),
    "backslashes": ("builtin: cornell", "file: scenes\\room.glb", 3, "'/'"),
    # Formats
    "a scene of another format": ("builtin: cornell", "file: room.obj", 3, ".glb"),
    "a picture as an environment": ("  lights:", "  environment: sky.jpg\n  lights:", 5, ".exr"),
    # Views
    "a camera behind the room": ("position: [0, 1, 3]", "position: [0, 1, -4]", 4, "'./voxray scene cornell'"),
    "a camera below the floor": ("position: [0, 1, 3]", "position: [0, -3, 0.5]", 4,
        "it sees the backs of surfaces, and no light"),
    "a camera in a box": ("position: [0, 1, 3], target: [0, 1, 0]", "position: [-0.35, 0.6, -0.3], target: [0, 0.6, 0]",
        4, "'./voxray scene cornell' gives a camera that sees the scene"),
    # What would do nothing
    "masks without a reference": ("reference: {pass: path_trace, spp: 8, bounces: 3}\n", "", 20,
        "measure.masks: no effect without a 'reference' to compare with; add one"),
    **{f"{what} without a reference": (REFERENCE_TO_MASKS, f"{SWEEP}measure: {{frames: 4, {key}: {value}}}", 20,
        f"measure.{key}: no effect without a 'reference' to compare with; add one")
       for what, key, value in (("a second seed", "second_seed", "true"), ("metrics", "metrics", "[flip]"),
                                ("a sequence", "compare_every", "1"))},
    "a light off after the last frame": (INTENSITY, "intensity: [1, 1, 1], off_at: 2", 6,
        "off_at: 2 is after the last frame, 1, so that it always shines"),
    "steps of time where nothing moves": ("  camera:", "  time_step: 0.1\n  camera:", 4,
        "nothing in the scene is animated: leave it out, or add 'moving_spheres'"),
    "a time where nothing moves": ("  camera:", "  time: 3\n  camera:", 4,
        "nothing in the scene is animated: leave it out, or add 'moving_spheres'"),
    "no lights by an empty list": (LAMP, "lights: []", 5, "write 'keep_file_lights: false' next to it"),
    "no metrics": ("frames: 2", "frames: 2, metrics: []", 21, "an empty list; leave it out to have all of nrmse, "),
    "a metric twice": ("frames: 2", "frames: 2, metrics: [flip, flip]", 21, "'flip'"),
    "a scale of no map": ("  lights:", "  environment: {scale: 2}\n  lights:", 5,
        "'map' is missing, as in {map: sky.exr, scale: 2}; for a radiance alone write environment: 2"),
    "a limit of memory that nothing fits in": ("frames: 2", "frames: 2, memory_limit_mb: 1", 21,
        "1 MiB are too few for 2 of 2 variants"),
    "an empty sweep": (SWEEP, "sweep: {}\n", 19, "{voxelize.resolution: [64, 128]}"),
    "a sweep of no values": ("[4096, 8192]", "[]", 20, "[64, 128]"),
    "two names for one value": (VALUES, "voxelize.method:\n    a: exact\n    b: exact", 22,
        "sweep.voxelize.method: 'a' and 'b' are the same"),
    # Blocks
    "a block below another one": ("image: {width", "  image: {width", 7,
        "'image' is a key of its own, next to 'scene': indent it as far as 'scene'"),
    "a slash for the dot": ("inject.rays_per", "inject/rays_per", 20, "'inject.rays_per_light'"),
    "inputs as a list": ("{noisy_irradiance: gather}", "[gather]", 15,
        "expected a map of ports and ids, as in {noisy_irradiance: gather}"),
    "passes without dashes": (GRAPH, "graph:\n  gbuffer: {}\n  voxelize: {resolution: 16}\n", 9,
        "expected a list of passes, each with a dash: write '- {pass: gbuffer}'"),
    "a pass's parameter without its pass": ("seed: 7", "resolution: 64", 8, "'voxelize'"),
    "a color by its name": (INTENSITY, "intensity: white", 6, "'white'"),
    "a color of the web": (INTENSITY, 'intensity: "#ff8800"', 6,
        "not '#ff8800', or three: write [1, 0.2462, 0], its linear values"),
    "a sky of the web": ("  lights:", '  environment: "#fff"\n  lights:', 5, "'#fff'"),
    "a color of the web without quotes": (INTENSITY, "intensity: #ff8800", 6,
        "is not closed: a '}' is missing, or a comma before line 10; what follows '#' there is a comment"),
    "a color of the web in a line of its own": ("{point: [0, 1.8, 0], intensity: [1, 1, 1]}",
        "point: [0, 1.8, 0]\n      intensity: #ff8800", 7, "'#'"),
    "the results' folder in the config": ("seed: 7", "output: results/mine", 8,
        "it is said on the command line: --out DIR"),
    "a built-in scene as a file": ("builtin: cornell", "file: cornell", 3,
        "that scene is built in: write builtin: cornell"),
    "a file as a built-in scene": ("builtin: cornell", "builtin: mine.yaml", 3, "write file: mine.yaml"),
    # Chains
    "a chain without its last pass": (VALUES, "indirect: [gather_irradiance, [trace_gather_rays]]", 20,
        "'trace_gather_rays' is never run: no image depends on what it writes; 'gather_irradiance' in its place writes"),
}
