"""Refusals of cams, followers, pins and offers in Ukrainian, one pattern a line; {} stands for a value."""

from __future__ import annotations

OFFERS = """
is the default, not given|це стандартне значення, його не задано
not given, it follows from the other keys|не задано, випливає з інших ключів
does not fit the other keys|не узгоджується з іншими ключами
table with {} = one of {}|таблиця, у якій {} - одне з {}
at least {}, at most {}: table|від {} до {} таблиць
give only one of them|задайте лише одне з них
follows from {}|випливає з {}
move it inside|пересуньте всередину
outside|зовні
roller, mushroom or pointed works|підходить roller, mushroom або pointed
a smaller one works|підходить менше
a larger one works|підходить більше
a smaller one elsewhere works|підходить менший в іншому місці
another y works|підходить інший y
another x or y works|підходить інший x або y
a base_circle_radius works|підходить base_circle_radius
another pivot_height or arm_length works|підходить інший pivot_height або arm_length
less swing works|підходить менший розмах
{} works with this cam|з цим кулачком підходить {}
{} works, the same in the cam's oscillating|підходить {}, так само в oscillating кулачка
{}, the same in the cam's oscillating|{}, так само в oscillating кулачка
"""

PARTS = """
the phases make {} degrees together, not 360|фази разом складають {} град, а не 360
a dwell has neither law nor share|відстій не має ні закону, ні частки
the arm does not reach this circle|коромисло не дістає до цього кола
the arm does not reach the plate|коромисло не дістає до плоского кулачка
the arm does not reach the cam: base circle and roller together must be {} to {} mm|\
коромисло не дістає до кулачка: основне коло разом з роликом має бути від {} до {} мм
the arm swings beyond the upright|коромисло переходить за вертикаль
leaves no plate under the lowest follower|під найнижчим штовхачем не лишається плоского кулачка
has no room for corner_radius|немає місця для corner_radius
rests on a sliding plate by its edge only|торкається плоского кулачка лише краєм
phases need one above 0|фазам потрібне значення більше за 0
the velocity jumps at a crest at {} mm of travel|на вершині при {} мм ходу швидкість має стрибок
the velocity jumps at cam angle {} degrees: the groove would have a corner that no roller follows|\
при куті кулачка {} град швидкість має стрибок: паз мав би кут, якого ролик не пройде
the velocity jumps at cam angle {} degrees|при куті кулачка {} град швидкість має стрибок
undercuts the crest at {} mm of travel|підрізає вершину при {} мм ходу
the follower runs along with the plate at {} mm of travel|при {} мм ходу штовхач рухається разом з кулачком
the follower undercuts the plate at {} mm of travel|при {} мм ходу штовхач підрізає кулачок
the hole has no room there|отвору там немає місця
has no room there|там немає місця
the hole's centre at y = {} lies outside the plate|центр отвору при y = {} лежить поза кулачком
meets the edge or another hole|зачіпає край або інший отвір
leaves no wall to the floor|не лишає стінки до дна
leaves no wall to the groove|не лишає стінки до паза
leaves no wall to the base circle|не лишає стінки до основного кола
leaves no wall in the boss|не лишає стінки в бобишці
leaves no wall in the roller|не лишає стінки в ролику
leaves no wall around the bore|не лишає стінки навколо отвору
leaves no wall|не лишає стінки
leaves no hole|не лишає отвору
leaves no room for the hub|не лишає місця для маточини
leaves no rim beyond the groove|не лишає обода за пазом
leaves no whole outline|не лишає цілого контуру
leaves no tooth between two pins|не лишає зуба між двома цівками
must stay inside|має лишатися всередині
the holes must stay inside the base circle, within {} mm of the axis|\
отвори мають лежати в основному колі, до {} мм від осі
the holes must stay inside the groove, within {} mm of the axis|отвори мають лежати всередині паза, до {} мм від осі
the groove needs more|пазу потрібно більше
the groove's {} wall is undercut and loses {}|стінка паза ({}) підрізана і втрачає {}
goes through: the disk would fall apart|проходить наскрізь: диск розпався б
has no room for a groove|не має місця для паза
the roller needs a wider floor|ролику потрібне ширше дно
the roller is too big for it|ролик для нього завеликий
the roller strays {} mm from the cam's axis, past its side|ролик відходить на {} мм від осі кулачка, за його бік
undercuts the wall at cam angle {} degrees|підрізає стінку при куті кулачка {} град
the roller outruns the cam's surface and undercuts the wall at cam angle {} degrees|\
ролик випереджає поверхню кулачка і підрізає стінку при куті {} град
turns the arm along the cam's axis|повертає коромисло вздовж осі кулачка
an open tube has only its inner cylinder, {} needs a bottom|відкрита труба має лише внутрішній циліндр, {} потребує дна
reaches the track|сягає доріжки
a roller on an end has no play|ролик на торці не має зазору
is for form = "end" only|лише для form = "end"
is for {} only|лише для {}
is for {}, not {}|призначено для {}, не для {}
is for {} followers|призначено для штовхачів {}
is for {} followers (a roller is a part of its own)|призначено для штовхачів {} (ролик - окрема деталь)
a {} follower has a plate|штовхач {} має тарілку
a mushroom has a radius above 0|гриб має радіус, більший за 0
a {} follower has {} instead|такий штовхач ({}) має натомість {}
the plate takes all of it|тарілка займає його весь
the plate has no room for it|тарілка не має для нього місця
is below the stem's width|менше за ширину стержня
is narrower than the stem|вужчий за стержень
the arc ends at its own diameter|дуга кінчається на власному діаметрі
must be longer than half its width|має бути довшим за половину ширини
the tip is {} mm long|вістря має довжину {} мм
the hook reaches the pivot|гачок сягає опори
the cap reaches the pivot|шапка сягає опори
is no cap|не є шапкою
ends within the pivot's boss|кінчається в бобишці опори
one end lies within the other|один кінець лежить у другому
the pivot lies outside of the bar|опора лежить поза планкою
the cam is made for another|кулачок зроблено для іншого
the cam is made for another follower|кулачок зроблено для іншого штовхача
the cam is made for {}, which works|кулачок зроблено для {}, підходить саме це
the contact runs over the bar's end|контакт виходить за кінець планки
the contact runs over the plate's edge|контакт виходить за край тарілки
the rollers must stand on both sides of the axis|ролики мають стояти з обох боків осі
the second cam is undercut|другий кулачок підрізаний
lies within the follower's offset|лежить у межах зміщення штовхача
is no cam of constant breadth: its follower oscillates|не є кулачком сталої ширини: його штовхач коромисловий
is no cam of constant breadth: its {} is {}|не є кулачком сталої ширини: його {} дорівнює {}
the mark meets the edge or another hole|мітка зачіпає край або інший отвір
finds no room inside the base circle|не має місця в основному колі
finds no room between the holes and the base circle|не має місця між отворами і основним колом
a flat face always pushes along its normal: 45 stands for the tangent's slope in S(S'')|\
тарілка завжди штовхає вздовж своєї нормалі: 45 означає нахил дотичної у S(S'')
lies outside of the part or in another hole|лежить поза деталлю або в іншому отворі
there are {} seats|гнізд є {}
{} pins touch each other|{} цівок торкаються одна одної
leaves no seat|не лишає гнізда
leaves nothing of the roller|нічого не лишає від ролика
is for flat followers only|лише для плоских штовхачів
buries the pins|ховає цівки
reaches the pins|сягає цівок
lies beyond the pins|лежить за цівками
of the other gear|іншого колеса
must be that of the holes|має бути таким, як в отворів
the pins' paths have loops (e N / R must stay below {})|траєкторії цівок мають петлі (e N / R має бути менше за {})
the bore reaches the root circle, {} mm|отвір сягає кола западин, {} мм
the windows reach the root circle, {} mm|вікна сягають кола западин, {} мм
mates have opposite hands|спряжені колеса мають протилежні напрями гвинта
the flat stands on the axis or beyond it|лиска стоїть на осі або за нею
"""
