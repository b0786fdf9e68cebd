"""What is known of materials: densities by name and by mark, in the letters of their standards."""

from __future__ import annotations

from parts.base.psv import rows_of
from parts.base.texts import N_

# g/cm^3; typical values of makers' data sheets, a part's own key `density` goes before them.
# Names that are told in every language
NAMES = {
    N_("steel"): 7.85, N_("stainless steel"): 7.9, N_("cast iron"): 7.2, N_("brass"): 8.5, N_("bronze"): 8.8,
    N_("copper"): 8.96, N_("aluminium"): 2.7, N_("duralumin"): 2.78, N_("magnesium"): 1.74, N_("titanium"): 4.5,
    N_("zinc"): 7.14,
    N_("nylon"): 1.14, N_("cast nylon"): 1.15, N_("polyamide"): 1.14, N_("acetal"): 1.41, N_("polycarbonate"): 1.2,
    N_("polypropylene"): 0.91, N_("polyethylene"): 0.95, N_("polystyrene"): 1.05, N_("acrylic"): 1.19,
    N_("plexiglass"): 1.19, N_("resin"): 1.15, N_("rubber"): 1.2, N_("textolite"): 1.35, N_("glass textolite"): 1.85,
    N_("carbon fibre"): 1.55, N_("glass"): 2.5,
    N_("plywood"): 0.65, N_("chipboard"): 0.68, N_("hardboard"): 0.9, N_("mdf"): 0.75, N_("wood"): 0.6,
    N_("beech"): 0.72, N_("birch"): 0.65, N_("oak"): 0.7, N_("ash"): 0.69, N_("maple"): 0.66, N_("walnut"): 0.64,
    N_("lime"): 0.53, N_("pine"): 0.52, N_("spruce"): 0.45, N_("cardboard"): 0.7, N_("paper"): 0.8, N_("cork"): 0.2,
}  # fmt: skip
# marks, and the same names in other letters
ROWS = [(float(density), row) for density, row in rows_of(__file__, "densities")]
DENSITIES = NAMES | {mark: density for density, row in ROWS for mark in row.split(", ")}
