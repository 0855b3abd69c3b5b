"""What methods answer, as mappings whose keys are typed; written by generate.py from the server's /openapi.json."""

# This file is generated: change src/server/openapi, then run clients/python/generate.py.

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypedDict

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from typing_extensions import NotRequired  # typing has it since Python 3.11

Columns: TypeAlias = dict[str, NDArray[np.float64]]


class PlanPass(TypedDict):
    name: Literal['trace', 'interpolate', 'footprint', 'audit', 'particles', 'stars', 'transfer', 'march', 'march_error', 'refine', 'layers', 'light', 'beam', 'expose', 'bloom', 'post', 'readback']
    kernel: NotRequired[str]
    invocations: int
    estimate_ms: float


class PlanConstants(TypedDict):
    orders: int
    steps: int
    samples: int
    radius_only: bool
    phi: bool
    sky: bool


class PlanAccuracy(TypedDict):
    engine: Literal['closed', 'mino-rkn4', 'mino-rkn6', 'ks-euler', 'ks-rk4', 'ks-tao6']
    precision: Literal['f32', 'f64']
    steps: int
    holds: NotRequired[float]
    table: Literal['measured', 'built-in']


class PlanBytes(TypedDict):
    lens_map: int
    device: int
    host: int


class Plan(TypedDict):
    rays: int
    critical_pixels: int
    critical_rays: int
    width: int
    height: int
    eyes: NotRequired[int]
    strips: NotRequired[int]
    passes: list[PlanPass]
    specialisation: PlanConstants
    accuracy: PlanAccuracy
    bytes: PlanBytes
    bands: int
    lens_map_cacheable: bool
    lens_map_key: str
    kernels_ms: NotRequired[float]
    estimate_ms: float
    estimate_basis: Literal['measured', 'guess']
    approximations: list[str]


RayConstants = TypedDict('RayConstants', {
    'alpha': 'float',
    'beta': 'float',
    'lambda': 'float',
    'eta': 'float',
    'E': 'float',
    'L': 'float',
    'Q': 'float',
    'outward': 'bool',
})


class RayRadial(TypedDict):
    case: Literal['I', 'II', 'III', 'IV']
    real_roots: int
    roots: list[list[float]]
    horizon_r: float
    turning_r: float | None


class RayPolar(TypedDict):
    case: Literal['ordinary', 'vortical', 'fixed']
    roots: list[float]
    theta: list[float]


class PixelPictured(TypedDict):
    r: float
    g: float
    footprint: NotRequired[float]


class PixelGlow(TypedDict):
    name: Literal['disk', 'particles', 'plunge', 'spots', 'ringdown', 'sky', 'gas', 'volume', 'jets', 'thick', 'bodies', 'debris', 'polarization', 'plasma', 'stokes', 'lamp', 'flash']
    light: list[float]
    seen: list[float]
    luminance: float
    luminance_seen: float
    opacity: NotRequired[float]
    points: NotRequired[bool]


class PixelCrossing(TypedDict):
    order: int
    r: float | None
    phi: float | None
    azimuth: float | None
    delay: float | None
    g: float | None
    seen: bool
    temperature: NotRequired[float]
    emission_angle: NotRequired[float]
    speed: NotRequired[float | None]
    approach: NotRequired[float | None]
    evpa: NotRequired[float | None]
    polarization_fraction: NotRequired[float | None]
    picture: NotRequired[PixelPictured]
    through: NotRequired[float]
    emitters: NotRequired[list[PixelGlow]]
    optical_depth: NotRequired[float | None]


class PixelVolume(TypedDict):
    name: Literal['disk', 'particles', 'plunge', 'spots', 'ringdown', 'sky', 'gas', 'volume', 'jets', 'thick', 'bodies', 'debris', 'polarization', 'plasma', 'stokes', 'lamp', 'flash']
    seen: list[float]
    luminance_seen: float
    optical_depth: float | None


class PixelStretch(TypedDict):
    order: int
    from_r: float | None
    from_theta: float
    from_delay: float | None
    to_r: float | None
    to_theta: float
    to_delay: float | None
    seen: list[float]
    through: float
    optical_depth: float | None


class PixelAlong(TypedDict):
    names: list[str]
    steps: int
    samples: int
    seen: list[float]
    luminance_seen: float
    optical_depth: float | None
    delay: float | None
    volumes: list[PixelVolume]
    stretches: NotRequired[list[PixelStretch]]


class PixelMet(TypedDict):
    name: Literal['disk', 'particles', 'plunge', 'spots', 'ringdown', 'sky', 'gas', 'volume', 'jets', 'thick', 'bodies', 'debris', 'polarization', 'plasma', 'stokes', 'lamp', 'flash']
    index: int
    order: int
    r: float
    theta: float
    phi: float
    azimuth: float | None
    g: float
    emission_angle: float
    light: list[float]
    seen: list[float]
    luminance_seen: float
    through: float


class PixelEnd(TypedDict):
    fate: Literal['captured', 'escaped', 'undecided']
    why: str
    through: float
    optical_depth: float | None
    theta: NotRequired[float | None]
    phi: NotRequired[float | None]
    azimuth: NotRequired[float | None]
    g: NotRequired[float]
    emitters: list[PixelGlow]


class PixelPolarization(TypedDict):
    stokes: list[float]
    evpa: float | None
    polarization_fraction: float | None


class PixelColour(TypedDict):
    shown: list[float]
    pixel: list[float]
    ray: list[float]
    exposure: float


class PixelPath(TypedDict):
    steps: int
    least_r: float
    coordinates: Literal['ingoing', 'Boyer-Lindquist']
    whole: bool
    columns: list[str]
    points: list[list[float | None]]


class PixelTrace(TypedDict):
    none: NotRequired[str]
    engine: NotRequired[Literal['closed', 'mino-rkn4', 'mino-rkn6', 'ks-euler', 'ks-rk4', 'ks-tao6']]
    precision: NotRequired[Literal['f32', 'f64']]
    steps_a_half_period: NotRequired[int]
    fate: NotRequired[Literal['captured', 'escaped', 'undecided']]
    crossings: NotRequired[int]
    not_shown: NotRequired[int]
    same_without_trace: NotRequired[bool]
    columns: NotRequired[list[str]]
    steps: NotRequired[list[list[float | None | str]]]


class PixelAccuracy(TypedDict):
    engine: Literal['closed', 'mino-rkn4', 'mino-rkn6', 'ks-euler', 'ks-rk4', 'ks-tao6']
    precision: Literal['f32', 'f64']
    steps: int
    closed_form: float | None
    picture: float | None
    path: float | None
    first_integrals: float | None
    sum: float | None


class PixelRay(TypedDict):
    ray_at: list[float]
    weight: float
    constants: RayConstants
    radial: RayRadial
    polar: RayPolar
    crossings: list[PixelCrossing]
    along: NotRequired[PixelAlong]
    met: NotRequired[PixelMet]
    end: PixelEnd
    polarization: NotRequired[PixelPolarization]
    lost: int
    light: list[float]
    luminance: float
    closed_form: float | None
    picture: float | None


class Pixel(TypedDict):
    ray_at: list[float]
    weight: float
    constants: RayConstants
    radial: RayRadial
    polar: RayPolar
    crossings: list[PixelCrossing]
    along: NotRequired[PixelAlong]
    met: NotRequired[PixelMet]
    end: PixelEnd
    polarization: NotRequired[PixelPolarization]
    lost: int
    pixel: list[float]
    eye: NotRequired[Literal['left', 'right']]
    rays: int
    colour: PixelColour
    path: PixelPath
    pixel_polarization: NotRequired[PixelPolarization]
    trace: NotRequired[PixelTrace]
    accuracy: PixelAccuracy
    each_ray: list[PixelRay]
    approximations: list[str]


class OrbitConstants(TypedDict):
    energy: float
    binding: float
    angular_momentum: float
    carter: float
    binet_c: NotRequired[float | None]


class OrbitTurningPoints(TypedDict):
    r_min: float | None
    r_max: float | None
    theta_min_deg: float
    theta_max_deg: float | None


class OrbitShape(TypedDict):
    p: float
    e: float
    inclination_deg: float


class OrbitMinoFrequencies(TypedDict):
    r: float | None
    theta: float | None
    phi: float | None
    t: float | None
    tau_proper: float | None


class OrbitThreeFrequencies(TypedDict):
    r: float | None
    theta: float | None
    phi: float | None


class OrbitFrequencies(TypedDict):
    mino: OrbitMinoFrequencies
    coordinate: OrbitThreeFrequencies
    proper: OrbitThreeFrequencies
    hz: NotRequired[OrbitThreeFrequencies]


class OrbitAdvance(TypedDict):
    periastron: float | None
    weak_field: float | None
    node: float | None
    periastron_arcsec_per_century: NotRequired[float | None]


class OrbitDrift(TypedDict):
    energy: float | None
    angular_momentum: float
    carter: float | None
    mass: float | None
    binet_c: NotRequired[float | None]


class OrbitDifference(TypedDict):
    tau_proper: float | None
    t: float | None
    r: float | None
    theta: float | None
    phi: float | None


class OrbitResult(TypedDict):
    method: Literal['yoshida6', 'rkn6', 'closed']
    end: Literal['duration', 'horizon', 'r_max']
    mino_end: float | None
    steps: NotRequired[int]
    mino_step: NotRequired[float | None]
    error_estimate: NotRequired[float | None]
    drift: NotRequired[OrbitDrift]
    periastra: NotRequired[int]
    periastron_advance_measured: NotRequired[float | None]
    closed_form_difference: NotRequired[OrbitDifference]
    approximations: list[str]


class OrbitPath(TypedDict):
    spin: float
    charge: NotRequired[float]
    fate: Literal['bound', 'plunge', 'escape']
    circular: bool
    constants: OrbitConstants
    turning_points: OrbitTurningPoints
    shape: NotRequired[OrbitShape]
    frequencies: NotRequired[OrbitFrequencies]
    advance: NotRequired[OrbitAdvance]
    series: NotRequired[Columns]
    result: OrbitResult


class OrbitPaths(TypedDict):
    orbits: list[OrbitPath]


class LineProfileParameters(TypedDict):
    spin: float
    charge: float
    inclination_deg: float
    inner: float
    outer: float
    emissivity: str
    index: float
    outer_index: float
    break_r: float
    height: float
    corona_radius: float
    corona_inner: float
    corona_top: float
    motion: str
    photon_index: float
    limb: str
    tolerance: float
    counts: str
    rest_energy: float
    energy_min: float
    energy_max: float
    bins: float


class LineProfileValues(TypedDict):
    isco: float | None
    total: float | None
    inside: float | None
    error: float | None
    strength: float | None
    direct_flux: float | None
    direct_g: float | None


class LineProfile(TypedDict):
    integral: Literal['line']
    parameters: LineProfileParameters
    values: LineProfileValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]


class TransferFunctionParameters(TypedDict):
    spin: float
    charge: float
    inclination_deg: float
    inner: float
    outer: float
    rings: float
    g_stars: float


class TransferFunctionValues(TypedDict):
    isco: float | None


class TransferFunction(TypedDict):
    integral: Literal['transfer-function']
    parameters: TransferFunctionParameters
    values: TransferFunctionValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]


class ImpulseResponseParameters(TypedDict):
    spin: float
    charge: float
    inclination_deg: float
    inner: float
    outer: float
    emissivity: str
    height: float
    corona_radius: float
    motion: str
    photon_index: float
    limb: str
    rest_energy: float
    energy_min: float
    energy_max: float
    bins: float
    time_min: float
    time_max: float
    times: float
    mass_msun: float


class ImpulseResponseValues(TypedDict):
    isco: float | None
    strength: float | None
    direct_flux: float | None
    direct_g: float | None
    direct_time: float | None
    unit_s: float | None
    inside: float | None
    mean_time: float | None
    error: float | None


class ImpulseResponse(TypedDict):
    integral: Literal['impulse']
    parameters: ImpulseResponseParameters
    values: ImpulseResponseValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]


class LagsParameters(TypedDict):
    spin: float
    charge: float
    inclination_deg: float
    inner: float | str
    outer: float
    emissivity: str
    height: float
    corona_radius: float
    motion: str
    photon_index: float
    limb: str
    rest_energy: float
    energy_min: float
    energy_max: float | str
    bins: float
    frequency_min: float
    frequency_max: float
    frequencies: float
    reflection: float
    reference_min: float | str
    reference_max: float | str
    mass_msun: float


class LagsValues(TypedDict):
    isco: float | None
    strength: float | None
    direct_flux: float | None
    direct_g: float | None
    direct_time: float | None
    unit_s: float | None
    error: float | None


class Lags(TypedDict):
    integral: Literal['lags']
    parameters: LagsParameters
    values: LagsValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]


class DiskSpectrumParameters(TypedDict):
    spin: float
    charge: float
    inclination_deg: float
    inner: float
    outer: float
    limb: str
    mass_msun: float
    distance_pc: float
    mdot_edd: float
    colour_correction: float
    returning: str
    polarization: str
    frequency_min_hz: float
    frequency_max_hz: float
    frequencies: float


class DiskSpectrumValues(TypedDict):
    isco: float | None
    t_max_k: float | None
    luminosity_w: float | None
    error: float | None


class DiskSpectrum(TypedDict):
    integral: Literal['spectrum']
    parameters: DiskSpectrumParameters
    values: DiskSpectrumValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]


class VolumeSpectrumParameters(TypedDict):
    frequency_min_hz: float
    frequency_max_hz: float
    frequencies: float
    pixels: float
    check: str


class VolumeSpectrumValues(TypedDict):
    width: float | None
    height: float | None
    error: float | None


class VolumeSpectrum(TypedDict):
    integral: Literal['spectrum']
    parameters: VolumeSpectrumParameters
    values: VolumeSpectrumValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]
    scene: dict[str, Any]


class VisibilitiesParameters(TypedDict):
    length_max: float | str
    baselines: float
    orders: float
    pixels: float
    check: str
    digits: float


class VisibilitiesValues(TypedDict):
    flux_jy: float | None
    pixel_uas: float | None
    width_uas: float | None
    height_uas: float | None
    nyquist_gl: float | None
    edge_share: float | None
    undefined: float | None
    error: float | None


class Visibilities(TypedDict):
    integral: Literal['visibility']
    parameters: VisibilitiesParameters
    values: VisibilitiesValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]
    scene: dict[str, Any]


class ComparisonParametersSystematic(TypedDict):
    visibility: float
    amplitude: float
    closure_phase_deg: float


class ComparisonParameters(TypedDict):
    products: list[str]
    average_s: float
    uv_min_gl: float
    snr_cut: float
    systematic: ComparisonParametersSystematic
    debias: str
    closures: str
    pulse: str
    scattering: str
    flux_jy: float | str
    solve: list[str]
    pixels: float
    check: str
    digits: float


class ComparisonValues(TypedDict):
    flux_jy: float | None
    pixel_uas: float | None
    width_uas: float | None
    height_uas: float | None
    nyquist_gl: float | None
    edge_share: float | None
    undefined: float | None
    model_error: float | None
    size: float | None
    position_angle_deg: float | None
    shift_east_uas: float | None
    shift_north_uas: float | None


class ComparisonChi2(TypedDict):
    amplitude: float | None
    closure_phase: float | None
    log_closure_amplitude: float | None
    visibility: float | None


class ComparisonChi2Finer(TypedDict):
    amplitude: float | None
    closure_phase: float | None
    log_closure_amplitude: float | None
    visibility: float | None


class ComparisonN(TypedDict):
    amplitude: int
    closure_phase: int
    log_closure_amplitude: int
    visibility: int


class ComparisonSolved(TypedDict):
    name: str
    value: float | None
    converged: bool


class ComparisonObservation(TypedDict):
    source: str
    mjd: float
    frequency_ghz: float
    stations: list[str]
    visibilities: int
    flagged: int
    duplicates: int
    averaged: int
    too_short: int


class Comparison(TypedDict):
    integral: Literal['compare']
    parameters: ComparisonParameters
    values: ComparisonValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]
    scene: dict[str, Any]
    chi2: ComparisonChi2
    chi2_finer: ComparisonChi2Finer
    n: ComparisonN
    solved: list[ComparisonSolved]
    observation: ComparisonObservation


class ComparisonOfSetsParametersSystematic(TypedDict):
    visibility: float
    amplitude: float
    closure_phase_deg: float


class ComparisonOfSetsParameters(TypedDict):
    products: list[str]
    average_s: float
    uv_min_gl: float
    snr_cut: float
    systematic: ComparisonOfSetsParametersSystematic
    debias: str
    closures: str
    pulse: str
    scattering: str
    flux_jy: float | str
    solve: list[str]
    pixels: float
    check: str
    digits: float


class ComparisonOfSetsValues(TypedDict):
    pictures: float | None
    pixel_uas: float | None
    width_uas: float | None
    height_uas: float | None
    nyquist_gl: float | None
    edge_share: float | None
    undefined: float | None


class ComparisonOfSetsObservation(TypedDict):
    source: str
    mjd: float
    frequency_ghz: float
    stations: list[str]
    visibilities: int
    flagged: int
    duplicates: int
    averaged: int
    too_short: int


class ComparisonOfSetsN(TypedDict):
    amplitude: int
    closure_phase: int
    log_closure_amplitude: int
    visibility: int


class ComparisonOfSets(TypedDict):
    integral: Literal['compare']
    parameters: ComparisonOfSetsParameters
    values: ComparisonOfSetsValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]
    scene: dict[str, Any]
    observation: ComparisonOfSetsObservation
    n: ComparisonOfSetsN


class SimulationParameters(TypedDict):
    pulse: str
    scattering: str
    flux_jy: float | str
    noise: str
    seed: float
    pixels: float
    check: str


class SimulationValues(TypedDict):
    flux_jy: float | None
    pixel_uas: float | None
    width_uas: float | None
    height_uas: float | None
    nyquist_gl: float | None
    edge_share: float | None
    undefined: float | None
    model_error: float | None


class SimulationObservation(TypedDict):
    source: str
    mjd: float
    frequency_ghz: float
    stations: list[str]
    visibilities: int
    flagged: int
    duplicates: int


class Simulation(TypedDict):
    integral: Literal['observe']
    parameters: SimulationParameters
    values: SimulationValues
    columns: Columns
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]
    scene: dict[str, Any]
    observation: SimulationObservation


class PresetTold(TypedDict):
    name: str
    label: str
    title: str


class DeviceSelftest(TypedDict):
    result: Literal['passed', 'failed', 'not run']
    checks: NotRequired[int]
    failed: NotRequired[int]
    seconds: NotRequired[float]
    now: NotRequired[bool]
    first_failure: NotRequired[str]


class DeviceLimits(TypedDict):
    heap_bytes: int
    memory_bytes: int
    memory_by: str
    binding_bytes: int
    allocation_bytes: int
    workgroups: int
    subgroup_size: int


class DeviceFigures(TypedDict):
    basis: Literal['measured', 'guess']
    ray_radius: float
    ray_full: float
    sample_transfer: float
    pixel_post: float
    ray_march: float
    ray_refined: float
    ray_stars: float
    sample_stars: float
    particle: float


class Device(TypedDict):
    kerrd: str
    name: str
    type: Literal['other device', 'CPU', 'virtual GPU', 'integrated GPU', 'discrete GPU']
    driver: str
    driver_info: str
    vulkan: str
    index: int
    choice: str
    precision: list[Literal['f32', 'f64']]
    float64_hardware: bool
    timestamps: bool
    selftest: DeviceSelftest
    limits: DeviceLimits
    ns_per_item: DeviceFigures


class EmitterTold(TypedDict):
    name: str
    title: str
    at: str
    apart: bool
    sentence: NotRequired[str]


class SessionPath(TypedDict):
    at: float
    end: float


class SessionRendering(TypedDict):
    fraction: float
    remaining_s: float | None


class SessionRefining(TypedDict):
    fraction: float
    remaining_s: float | None


class FallClock(TypedDict):
    proper_time_to_horizon: float | None
    proper_time_to_end: float
    proper_time_to_horizon_s: float | None
    proper_time_to_end_s: float


class Session(TypedDict):
    id: str
    token: NotRequired[str]
    revision: int
    frame: int
    viewers: int
    scene: dict[str, Any]
    varies: list[Literal['moves_with_time', 'dims_with_time', 'moves_with_azimuth']]
    emitters: list[EmitterTold]
    path: NotRequired[SessionPath]
    rendering: NotRequired[SessionRendering]
    refining: NotRequired[SessionRefining]
    clock: NotRequired[FallClock]
    order: NotRequired[int]


class Job(TypedDict):
    id: str
    token: NotRequired[str]
    state: Literal['waiting', 'running', 'done', 'failed', 'deleted']
    output: Literal['pictures', 'layers', 'npy', 'npz', 'fits', 'exr', 'cube', 'light-curve']
    place: int
    frames: int
    finished: int
    fraction: float
    remaining_s: float | None
    bytes: int
    lens_maps_traced: int
    exposure: NotRequired[float]
    axes: NotRequired[dict[str, int]]
    created: float
    ended: float | None
    delayed: NotRequired[str]
    error: NotRequired[str]


class Asset(TypedDict):
    sha256: str
    token: NotRequired[str]
    type: Literal['image/png', 'application/x-npz', 'application/x-uvfits', 'text/csv']
    width: NotRequired[int]
    height: NotRequired[int]
    bit_depth: NotRequired[int]
    channels: NotRequired[int]
    bytes: int
    created: float
    nodes: NotRequired[list[int]]
    frames: NotRequired[int]
    times: NotRequired[list[float]]
    spin: NotRequired[float]
    charge: NotRequired[float]
    visibilities: NotRequired[int]
    stations: NotRequired[int]


class Quantity(TypedDict):
    """A parameter that is a range, and each value that it changes, is an array in the shape of the ranges."""

    quantity: str
    parameters: dict[str, str | float | NDArray[np.float64]]
    ranges: NotRequired[list[str]]
    shape: NotRequired[tuple[int, ...]]
    values: dict[str, Any]
    units: dict[str, str]
    sources: list[str]
    approximations: list[str]
