"""Refusals of cams under linkages in Ukrainian, one pattern a line: English|Ukrainian, {} for a value."""

LINKAGES = """
the linkage comes apart or stands in line within the motion|механізм розмикається або стає у мертве положення
more than {} and less than {} mm closes it|замикається при понад {} і менше ніж {} мм
more than {} mm closes it|замикається при понад {} мм
the face looks away from the axis|тарілка відвернута від осі кулачка
the face passes the axis|площина тарілки проходить через вісь кулачка
the follower reaches the axis|штовхач сягає осі кулачка
the follower comes nearer to the axis while it should rise|штовхач наближається до осі, коли має віддалятися
the pressure angle reaches 90 degrees within the motion|кут тиску під час руху сягає 90 град
a dead point or a pressure angle of 90 degrees is too near|надто близько мертве положення або кут тиску 90°
the flat face turns as fast as the cam somewhere|тарілка десь обертається так швидко, як кулачок
no other value near it helps|інше значення поблизу не допомагає
is for flat and mushroom followers only|лише для плоских і грибкових штовхачів
the linkage carries the follower|штовхач стоїть на шатуні
this member is a slider|ця ланка є повзуном
the linkage has another|у механізмі інша довжина
the cam is made for another follower|кулачок зроблено для іншого штовхача
the cam is made for another|кулачок зроблено для іншого
{} works with another {}|підходить {}, якщо змінити {}
{} mm works with another {}|підходить {} мм, якщо змінити {}
{} degrees works with another {}|підходить {} град, якщо змінити {}
{} works with this cam|з цим кулачком підходить {}
"{}" works|підходить "{}"
[{}] works|підходить [{}]
"""
