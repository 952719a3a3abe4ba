"""What is said of a picture to which something happened."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from raysteps.results.model import Diagnosis


@dataclass(frozen=True)
class Words:
    """`{}` stands for the detail."""

    title: str
    sees: str
    cause: str
    hint: str


_TABLE: Mapping[str, Words] = {
    "upside-down": Words(
        "the picture is upside down",
        "The picture is the right one, but its upper and lower edge have changed places.",
        "Rows were counted from the bottom, or a vertical axis points the other way.",
        "Row 0 is the uppermost row of a picture. Which way must it look from the middle?",
    ),
    "mirrored": Words(
        "left and right are swapped",
        "The picture is the right one, seen in a mirror.",
        "A horizontal axis points the other way: the factors of a cross product changed places, or x lost its sign.",
        "Column 0 is the leftmost column. Check with your right hand where the axis must point.",
    ),
    "half-turn": Words(
        "the picture is turned by 180 degrees",
        "The picture is the right one, turned on its head: left and right and up and down are swapped.",
        "Both axes of the picture point the other way.",
        "What would make both axes turn round at once?",
    ),
    "transposed": Words(
        "rows and columns are swapped",
        "The picture is the right one, folded over its diagonal.",
        "x was used where y belongs, and the other way round.",
        "Which of the two goes with the width?",
    ),
    "shifted-by-one": Words(
        "the picture is moved by one pixel",
        "Everything is in its place but for one pixel.",
        "Pixels were counted from 1, or an edge of the picture was taken for its neighbour.",
        "What is the number of the first pixel, and of the last?",
    ),
    "shifted-by-half": Words(
        "the picture is moved by half a pixel",
        "The colours are a little off everywhere, by half of what lies between two pixels.",
        "The rays go through corners of pixels rather than through their centres.",
        "Where in a pixel does its ray go through?",
    ),
    "negative": Words(
        "the colours are inverted",
        "Bright is dark, and every colour is the opposite one.",
        "A colour was subtracted from white.",
        "Follow one colour through your code: where does it get turned round?",
    ),
    "normals-reversed": Words(
        "all normals point the other way",
        "Every colour is the opposite one: the picture shows directions, and all of them are turned round.",
        "A normal has the wrong sign.",
        "Towards which side of the surface does the normal in the record point?",
    ),
    "red-and-blue-swapped": Words(
        "red and blue are swapped",
        "The colours are right but for red, which is blue, and blue, which is red.",
        "The channels were read or written in the order blue, green, red.",
        "Which of the three numbers of a colour comes first?",
    ),
    "channels-permuted": Words(
        "the colour channels are in another order ({} rather than RGB)",
        "Shapes and light are right, the colours are not.",
        "The three numbers of a colour or of a vector changed places.",
        "Which of the three numbers comes first, second and third?",
    ),
    "axes-exchanged": Words(
        "the numbers x, y and z of the vectors are in another order",
        "The picture shows directions as colours, x as red, y as green, z as blue. Its colours changed places.",
        "Two components of a vector were exchanged.",
        "Which of the three numbers of the vector comes first, second and third?",
    ),
    "grey": Words(
        "the colours are lost",
        "The light is right, but everything is grey.",
        "One number was used for all three channels.",
        "What is done for red must be done for green and blue with their own numbers.",
    ),
    "gamma-applied": Words(
        "the levels are gamma-encoded",
        "Dark parts are much too bright, black and white are right.",
        "A power or a square root was applied to the colours before they became bytes.",
        "The handout maps colours to bytes in a straight line. Is there a step too many?",
    ),
    "gamma-removed": Words(
        "the levels are squared or raised to a power",
        "Dark parts are much too dark, black and white are right.",
        "A power was applied to the colours, or a product was taken twice.",
        "Is there a factor that is multiplied in twice?",
    ),
    "too-bright": Words(
        "everything is {} times as bright as it should be",
        "Shapes and colours are right, but the whole picture is too bright.",
        "A factor is missing or was applied too often, or something was added up more than once.",
        "Where does a number of that size come from, and where should it be multiplied in?",
    ),
    "too-dark": Words(
        "everything is only {} times as bright as it should be",
        "Shapes and colours are right, but the whole picture is too dark.",
        "A factor was multiplied in that does not belong there, or only a part of the light was added up.",
        "Compare one pixel by hand: which number is too small?",
    ),
    "plain-colours": Words(
        "the surfaces show their plain colour, whatever the light",
        "The picture is flat: no side of a thing is darker than another.",
        "The colour of the fill was returned as it is.",
        "On which two directions does the light depend that a surface sends to the eye?",
    ),
    "no-shadows": Words(
        "nothing lies in shadow",
        "The picture is that of step 03: the light goes through everything.",
        "No blocker is ever found, or what is found is not asked for.",
        "Try one point of which you know that it lies in shadow. What does its shadow ray meet, and at which distance?",
    ),
    "no-mirrors": Words(
        "nothing is mirrored",
        "The picture is that of step 04: the mirrors show only their own colour.",
        "The bounced ray is never cast, or what it brings is thrown away.",
        "Follow one ray that meets a mirror. When does it bounce, and where does the colour that it finds go?",
    ),
    "clamped": Words(
        "the colours are cut off at 1 rather than mapped",
        "The picture is that of step 06: bright parts are white and have lost their details.",
        "The tone map returns its colour as it is, or only limits it.",
        "What becomes of two colours that are both above 1?",
    ),
    "no-glass": Words(
        "glass lets nothing through",
        "The picture is that of step 07: what is of glass shows only its own light.",
        "The transmitted ray is never cast, or what it brings is thrown away.",
        "Follow one ray that meets glass. When does it go on, and where does the colour that it finds go?",
    ),
}

# What the picture of an earlier step means where it comes out of a later one.
BEFORE: Mapping[int, tuple[str, int]] = {
    3: ("plain-colours", 2),
    4: ("no-shadows", 3),
    5: ("no-mirrors", 4),
    7: ("clamped", 6),
    8: ("no-glass", 7),
}


def in_words(name: str, detail: str, seen_in: Sequence[str]) -> Diagnosis:
    words = _TABLE[name]
    title = words.title.format(detail)
    return Diagnosis("transformation", name, title, words.sees, words.cause, words.hint, list(seen_in))
