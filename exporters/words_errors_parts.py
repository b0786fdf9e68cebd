"""Refusals of gears, wheels, pairs and cams in Ukrainian, one pattern a line: English|Ukrainian, {} for a value."""

GEARS = """
{} teeth work|підходить {} зубців
{} (numbers of the transverse section)|{} (числа торцевого перерізу)
at least {} mm, the base circle, works|підходить щонайменше {} мм, основне коло
the flanks do not reach each other: an active line longer than 0 works|профілі не дістають один до одного: потрібна \
активна лінія довша за 0
must be between root and tip circle, {} to {} mm|має бути між колами западин і вершин, від {} до {} мм
a smaller least_contact_ratio or least_tip_thickness may work|може підійти менше least_contact_ratio або \
least_tip_thickness
{} is not in table {}|{} немає в таблиці {}
the nearest pair there is {}|найближча пара там {}
has no recommendation with {}|не має поради до {}
has no recommendation|не має поради
the tables take the smaller gear as the first|у таблицях першим стоїть менше колесо
give mate = the number of one|задайте mate = номер однієї з них
give either tip_chamfer or tip_rounding|задайте або tip_chamfer, або tip_rounding
does not fit between flank and tip land|не вміщується між профілем і вершиною
does not fit the tip land|не вміщується на вершині
both chamfers of a tooth would overlap|обидві фаски зуба перекрились би
does not cut the flank|не зрізає профілю
at most {} stays on the flank|щонайбільше {} лишається на профілі
leaves no flank|не лишає профілю
leaves no tip|не лишає вершини
the fillets of both sides meet inside the tooth|перехідні криві обох боків сходяться всередині зуба
no part of the involute is left below the tip circle|під колом вершин не лишається евольвенти
the flanks meet below the root form circle|профілі сходяться нижче за початок евольвенти
the tooth is pointed at a diameter of {} mm|зуб загострюється на діаметрі {} мм
the tooth is pointed below its tip line|зуб загострюється нижче за лінію вершин
the tooth is pointed|зуб загострений
the ring's tooth is pointed|зуб вінця загострений
the flanks of a ring tooth meet at its root|профілі зуба вінця сходяться біля западини
the relief leaves no main flank|фланк не лишає основного профілю
the relieved flanks of the rack meet below its tip line (0.02 is customary)|\
зрізані боки рейки сходяться нижче за вершини (звично 0.02)
the rack tooth is pointed at {} degrees before it reaches its tip line|\
при {} град зуб рейки загострюється до лінії вершин
the tooth of rack {} is pointed before it reaches its tip line|зуб рейки {} загострюється до лінії вершин
does not fit the rack tooth|не вміщується на зубі рейки
at most {} does (the full round)|щонайбільше {} підходить (повне заокруглення)
at most {} fits addendum_coefficient = {}|щонайбільше {} підходить до addendum_coefficient = {}
is not made on helical teeth|на косих зубах не виконується
needs helix_angle_deg above 0|потребує helix_angle_deg більше за 0
a double helical gear meshes with another one only|шевронне колесо зчіплюється лише з шевронним
helical racks have none|косозубі рейки їх не мають
remove holes|приберіть holes
remove cutter|приберіть cutter
reaches the root circle, {} mm|сягає кола западин, {} мм
the tip circle lies below the base circle|коло вершин лежить під основним колом
the cutter's tooth is pointed below its tip circle|зуб довбача загострюється нижче за коло вершин
a smaller profile shift or more teeth work|підходить менше зміщення або більше зубців
does not fit the cutter's tooth|не вміщується на зубі довбача
the space is pointed below its tip circle|западина загострюється нижче за своє дно
does not fit the space|не вміщується у западині
a rack stands for larger ones|більші замінює рейка
no pressure angle with the cutter exists|кута зачеплення з довбачем не існує
the cutter's involute ends at its base circle, below the gear's tips|\
евольвента довбача кінчається на основному колі, нижче за вершини колеса
a pinion cutter cuts none|довбач його не ріже
the cutter makes the root, by its own addendum and tip rounding|западину утворює довбач своєю головкою і заокругленням
the cutter's teeth begin above the ring's tips, which it would trim|\
зуби довбача починаються вище за вершини вінця і зрізали б їх
the cutter's tips would trim the ring's on their way out|вершини довбача зрізали б вершини вінця на виході
the cutter cannot be fed in radially without trimming the ring's tips|\
довбач не можна подати радіально, не зрізавши вершин вінця
must be less than the ring's|має бути менше, ніж у вінця
the involute ends at the base circle|евольвента кінчається на основному колі
must be above the root diameter|має бути більше за діаметр западин
at least {} mm leaves a rim|щонайменше {} мм лишає обід
the holes reach the root circle, {} mm|отвори сягають кола западин, {} мм
the holes reach the outside of the rim, {} mm|отвори сягають зовнішнього боку обода, {} мм
the holes reach {}|отвори сягають {}
the holes touch each other|отвори торкаються один одного
the holes touch those of another group|отвори торкаються отворів іншої групи
the holes reach the root line|отвори сягають лінії западин
the holes reach the bottom|отвори сягають низу
the holes reach the ends|отвори сягають країв
is no less than the body's height|не менше за висоту тіла
leaves a wall below {} mm: {}|лишає стінку меншу за {} мм: {}
one keyway or two opposite ones|один шпонковий паз або два протилежні
the keyway is as wide as the bore|паз такий широкий, як отвір
the keyway's bottom has no room for it|на дні паза для нього немає місця
the flat stands on the axis or beyond it|лиска стоїть на осі або за нею
the flat stands outside the bore|лиска стоїть поза отвором
the roundings leave no flat side|заокруглення не лишають плоского боку
the spokes fill the hub ring between them|спиці заповнюють усе кільце маточини
the window has no room for it|у вікні для нього немає місця
reaches the outer diameter|сягає зовнішнього діаметра
{} has keys for shafts of {} to {} mm|{} має шпонки для валів від {} до {} мм
others need width and depth|іншим потрібні width і depth
must be that of the gear|має бути таким, як у колеса
must be that of the pinion|має бути таким, як у шестірні
must be that of its mate|має бути таким, як у спряженої деталі
must be that of the first gear|має бути таким, як у першого колеса
must be that of the first gear of the pair|має бути таким, як у першого колеса пари
must be above the pinion's|має бути більше, ніж у шестірні
no working pressure angle|кута зачеплення не існує
no working pressure angle with the {} {}: inv(alpha_w) = {} < 0|\
кута зачеплення з {} {} не існує: inv(alpha_w) = {} < 0
no working angle: the base circles are farther apart|кута зачеплення не існує: основні кола стоять далі
the teeth would overlap|зубці перекрились би
the teeth do not reach each other|зубці не дістають один до одного
the gears' own thinning and distance give more|власне стоншення коліс і відстань дають більше
leaves no whole teeth|не лишає цілих зубців
the pair has {} mm of normal backlash already|пара вже має {} мм нормального зазору
a part has no mate in itself|деталь не буває парою сама собі
is a {}|це {}
{} joins {}|{} з'єднує {}
kind = {} joins these two|ці дві з'єднує kind = {}
turns it into mesh|вводить його в зачеплення
shows no profile: it is more than half of the pitch|не показує профілю: більше за половину кроку
the device cuts with a rack|прилад ріже рейкою
the device cuts straight teeth|прилад ріже прямі зуби
without cutter it works, or name other gears in parts of the export|\
підходить без cutter, або назвіть інші колеса у parts
0 works, or name other gears in parts of the export|підходить 0, або назвіть інші колеса у parts
the device draws external gears|прилад креслить зовнішні колеса
name a spur_gear|назвіть spur_gear
a disk holds two wheels|на диску вміщується два колеса
one disk needs module {} and {} teeth for both wheels|на одному диску в обох колес модуль {} і {} зубців
the disk fits no paper|диск не вміщується на жодному аркуші
a smaller module works|підходить менший модуль
closes the tooth spaces|закриває западини
closes the holes|закриває отвори
closes the bore|закриває отвір
leaves no wall beside the holes|не лишає стінок біля отворів
leaves nothing of {} at the face|не лишає нічого від {} на торці
leaves no face between two edges|не лишає торця між двома краями
leaves no tooth|не лишає зуба
meets the other chamfer|зустрічає другу фаску
is within {}, {} mm|лежить у межах {}, {} мм
reaches {}, {} mm|сягає {}, {} мм
is higher than {}|вище за {}
pushes the web out of the rim|виштовхує диск з обода
at most {} mm works either way|щонайбільше {} мм підходить в обидва боки
at most the face width, {} mm, works|підходить щонайбільше ширина вінця, {} мм
rounds the edges that face_chamfer would cut|заокруглює краї, які зрізав би face_chamfer
at most {} mm works with face_chamfer|щонайбільше {} мм підходить разом з face_chamfer
no involute inside the base circle|всередині основного кола евольвенти немає
falls between the flanks|провалюється між профілями
is more than the nominal one|більше за номінальну
no pin touches the flanks of this space at that diameter|на цьому діаметрі жоден ролик не торкається профілів западини
the classes end at a centre distance of {} mm|класи кінчаються на міжосьовій відстані {} мм
give normal_backlash instead|задайте натомість normal_backlash
the reference circle leaves the teeth|ділильне коло виходить із зубців
above {} and below {} works|підходить більше за {} і менше за {}
must be a whole number of modules, at least 3|має бути цілим числом модулів, не менше трьох
d / m is {}|d / m дорівнює {}
give it or number_of_teeth|задайте його або number_of_teeth
no shifts keep all requirements|жодні зміщення не виконують усіх вимог
shifts are chosen for spur gears only|зміщення вибираються лише для прямозубих коліс
"""

CAMS = """
must lie inside the prime circle: at most {} mm to either side works|\
має лежати в колі теоретичного профілю: щонайбільше {} мм у кожен бік
the follower passes the axis|штовхач проходить через вісь
the follower swings beyond the line of centres: less lift or another base circle works|\
коромисло переходить лінію центрів: менший хід чи інше основне коло
1 (rises against the cam's turning) or -1 (with it) works|\
підходить 1 (віддаляється проти обертання кулачка) або -1 (за ним)
the face must stand nearer to the axis than the pivot|тарілка має стояти ближче до осі, ніж опора
the flat follower turns as fast as the cam somewhere: less lift or a longer phase works|\
плоске коромисло десь обертається так швидко, як кулачок: менший хід чи довша фаза
a {} has a radius above 0|{} має радіус більший за 0
a {} follower has none|штовхач {} його не має
an oscillating follower has none|коромисловий штовхач його не має
the phases must make 360 degrees together|фази разом мають складати 360 град
the last one {} degrees works|підходить остання {} град
at least one phase is needed|потрібна хоча б одна фаза
rises and returns must cancel: the follower has to come back|\
віддалення і наближення мають зрівнятися: штовхач має повернутися
at least 3 rows of angle and lift are needed|потрібно щонайменше 3 рядки кута і ходу
the first row must stand at cam angle 0|перший рядок має стояти на куті 0
angles must stay below one turn|кути мають бути менші за оберт
a rise or return needs a law|віддаленню чи наближенню потрібен закон руху
at 360 degrees the lift of 0, {}, must stand|на 360 град має стояти хід кута 0, {}
base circle and follower radius together must be above {} and below {} mm|\
основне коло разом з радіусом ролика мають бути більші за {} і менші за {} мм
below {} mm works|підходить менше за {} мм
both arms must embrace the axis: from {} to {} rad works|обидва плеча мають обіймати вісь: від {} до {} рад
S(phi) + S(phi + 180) departs from H by {}|S(φ) + S(φ + 180) відходить від H на {}
180 degrees of the motion follow from the others|180 град руху випливають з інших
the cone's apex stands above the floor; at most {} degrees works|вершина конуса вища за дно паза; підходить \
щонайбільше {} градусів
is for roller_form = "conical" only|лише для roller_form = "conical"
a groove needs a roller|пазу потрібен ролик
a conjugate cam needs rollers|спареному кулачку потрібні ролики
the second roller runs over the axis|другий ролик проходить через вісь
a yoke has two flat faces or two rollers and slides|рамка має дві тарілки або два ролики і рухається поступально
a yoke with rollers works at 0 only|рамка з роликами працює лише при 0
no point of the follower's profile touches: its motion never slides along it|жодна точка профілю штовхача не торкається
does not close: area above {}, below {}, so velocity does not return to 0|не замикається: площа зверху {}, знизу {}, \
швидкість не вертається до 0
the ramps together must be from 0 to 1 of the width|схили разом мають складати від 0 до 1 ширини
lies on the axis or holds what is no number: the follower does not rise|лежить на осі або містить не числа: штовхач не \
піднімається
lifts nothing: put the segments above the axis first|нічого не піднімає: спершу ділянки над віссю
usual is {}|звично {}
each (u from 0 to 1, order) once|кожна пара (u від 0 до 1, порядок) один раз
at u = {} the orders must be 0, 1, 2 ... without a gap|при u = {} порядки мають бути 0, 1, 2 ... без пропусків
contradict each other|суперечать одне одному
must have from {} to {} points, each with its ordinate|має мати від {} до {} точок, кожна з ординатою
arguments must rise|аргументи мають зростати
see row {}|дивіться рядок {}
at degree {} at least {} poles work|при степені {} підходить щонайменше {} полюсів
the last pole must lie above the first|останній полюс має бути вищим за перший
{} rising numbers between 0 and 1 work|підходить {} зростаючих чисел від 0 до 1
a flat face always pushes along its normal|тарілка завжди штовхає вздовж своєї нормалі
the cam is undercut at {} degrees: {} of lift is lost there|кулачок підрізаний на {} град: там втрачено {} ходу
the cam is undercut and loses {}|кулачок підрізаний і втрачає {}
a larger one works|підходить більший
a pressure angle above 0 and below 90 degrees works|підходить кут тиску більший за 0 і менший за 90 град
nothing remains of the profile|від профілю нічого не лишається
the undercut profile falls apart|підрізаний профіль розпадається
phases need a lift above 0|фазам потрібен хід більший за 0
the table holds the lift|хід стоїть у таблиці
a dwell has neither law nor share|відстій не має ні закону, ні частки
this follower has {} instead|цей штовхач має натомість {}
swing_deg belongs to the table {}|swing_deg належить до таблиці {}
give it, or least_transmission_angle_deg, from which the least one follows|\
задайте його або least_transmission_angle_deg, з якого він випливає
the prime circle is {} mm only|коло теоретичного профілю лише {} мм
a smaller roller or a base_circle_radius works|підходить менший ролик або base_circle_radius
the contact runs over the plate's edge|контакт виходить за край тарілки
the holes must stay inside the base circle: within {} mm of the axis works|\
отвори мають лежати в основному колі: до {} мм від осі
leaves no wall to the base circle|не лишає стінки до основного кола
is for translating flat and mushroom followers only|лише для поступальних плоских і грибкових штовхачів
has no area: it changes no velocity|не має площі: швидкість не міняється
must be above 0 and below 1|має бути більше за 0 і менше за 1
the flat face swings past the square to the line of centres|плоска грань переходить перпендикуляр до лінії центрів
at most {} degrees, or a base circle of at most {} mm, works|підходить не більше {} град або основне коло до {} мм
a law without rigid impacts, as law = "sine", or follower = "pointed" works|\
підходить закон без жорстких ударів, як law = "sine", або follower = "pointed"
a smaller lift or longer phases work|підходить менший хід або довші фази
a smaller lift, longer phases or a smaller follower_radius work|\
підходить менший хід, довші фази або менший follower_radius
angles must rise|кути мають зростати
row {} must stand above {} degrees|рядок {} має стояти вище {} град
angles must stay below one turn|кути мають бути меншими за один оберт
leaving it out works|без нього працює
the last row, at 360 degrees, must repeat the first row's lift|\
останній рядок, при 360 град, має повторювати хід першого
at least {} mm works, the same in the cam's oscillating|підходить щонайменше {} мм, так само в oscillating кулачка
the cam is made for another follower|кулачок розраховано на інший штовхач
the plate is made for another follower|плиту розраховано на інший штовхач
the cam is made for another|кулачок розраховано на інший
the cam is made for {}, which works|кулачок розраховано на {}, що й підходить
the plate slides less|хід плити менший
the plate lies on the other side|плита лежить з іншого боку
{} works with this cam|з цим кулачком підходить {}
{} works with this plate|з цією плитою підходить {}
the contact runs over the plate's edge|точка дотику виходить за край тарілки
the contact runs over the bar's end|точка дотику виходить за кінець коромисла
is made from another cam than the mate's first|виготовлено для іншого кулачка, ніж first
name that one|назвіть той
makes too many rows|дає забагато рядків
is no kind of cam|це не вид кулачка
one of {}|один із {}
give the first cam's keys under it, as of.follower=roller of.lift=20, or name a scene with the part|\
дайте під ним ключі першого кулачка, як of.follower=roller of.lift=20, або назвіть сцену
has {} of {}: {}|має {} деталей {}: {}
add part=ID|додайте part=ID
is no {}|це не {}
there are {}|є {}
the scene has none|у сцені таких немає
"""
